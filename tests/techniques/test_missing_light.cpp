// What is said of light that an integrator cannot find.
#include "nacre/techniques/missing_light.h"
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

const std::string grey = xml::number("sigma_t", 2) + xml::number("albedo", 0.9);
const std::string grey_matter = xml::medium("interior", grey);
const std::string vacuum_ball = xml::sphere({}, 1, xml::dielectric(1.5));
const std::string point_light =
    "<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"0\" z=\"5\"/></emitter>\n";
const std::string lamp_inside =
    "<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"0\" z=\"0.2\"/></emitter>\n";
const std::string sun =
    "<emitter type=\"directional\"><vector name=\"direction\" value=\"0, 0, -1\"/></emitter>\n";
const std::string spot =
    "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0, 0, 5\" "
    "target=\"0, 0, 0\" up=\"0, 1, 0\"/></transform></emitter>\n";

std::string named(const std::string& id, const std::string& inside) {
    return "<shape type=\"sphere\" id=\"" + id + "\">" + inside + "</shape>\n";
}
std::string integrator(const std::string& type) { return xml::integrator(type); }

class MissingLight : public Techniques {};

TEST_F(MissingLight, IsSaidOnceForEachKind) {
    const std::string rough =
        xml::bsdf("roughdielectric", xml::number("alpha", 0.2) + xml::number("int_ior", 1.5) +
                                         xml::number("ext_ior", 1));
    const auto unseen = [](const std::string& integrator, const std::string& what,
                           bool technique = false) {
        return "integrator '" + integrator + "' does not see the medium " + what +
               ": the picture is as if it were not there; use --integrator volpath" +
               (technique ? ", or a technique (--technique)" : "");
    };
    const auto unmet = [](const std::string& what, bool technique = true, bool volpath = false) {
        return "point, spot and directional lights do not shine through the smooth boundary of " +
               what +
               ": no path meets them there, and what they would light inside and behind is dark; "
               "use small area lights" +
               (volpath ? ", --integrator volpath" : "") +
               (technique ? ", a rough boundary or a technique (--technique)" : "");
    };
    const auto mirrored = [](const std::string& what) {
        return "light of point, spot and directional lights that the mirror of " + what +
               " throws onto what is around it is missing: no path meets them there; use small "
               "area lights";
    };
    const std::string sky = xml::constant_light(), mirror = xml::bsdf("conductor"),
                      wall = named("wall", xml::bsdf("diffuse"));
    const std::string tinted =
        xml::bsdf("dielectric", xml::number("specular_transmittance", 0.9)) + grey_matter;
    const std::string fog = xml::bsdf("null") + grey_matter,
                      jade = xml::dielectric(1.5) + grey_matter, glass = xml::dielectric(1.5),
                      marble = subsurface("dipole", word("method", "brdf")),
                      simulated = subsurface("dipole", word("method", "volpath"));
    const struct {
        std::string what, body;
        std::vector<std::string> said;
    } cases[] = {
        {"fog", integrator("path") + sky + named("a", fog), {unseen("path", "at 'a'", true)}},
        {"fog, ray", integrator("ray") + sky + named("a", fog), {unseen("ray", "at 'a'", true)}},
        {"jade", integrator("path") + sky + named("a", jade), {unseen("path", "at 'a'", true)}},
        {"two of them",
         integrator("path") + sky + named("a", fog) + named("b", jade),
         {unseen("path", "at 'a' and 'b'", true)}},
        {"four of them",
         integrator("path") + sky + named("a", fog) + named("b", fog) + named("c", fog) +
             named("d", fog),
         {unseen("path", "at 'a', 'b' and 2 more", true)}},
        {"outside",
         integrator("path") + sky + named("a", xml::bsdf("null") + xml::medium("exterior", grey)),
         {unseen("path", "at 'a'")}},
        {"a masked boundary",
         integrator("path") + sky +
             named("a", xml::bsdf("mask", xml::bsdf("diffuse")) + grey_matter),
         {unseen("path", "at 'a'")}},
        {"recursion has no techniques",
         integrator("ray") + sky + named("a", marble),
         {unseen("ray", "at 'a'", true)}},
        {"seen", integrator("volpath") + sky + named("a", fog) + named("b", jade), {}},
        {"by a technique", integrator("path") + sky + named("a", marble), {}},
        {"simulated", integrator("path") + sky + named("a", simulated), {}},
        {"behind an opaque surface",
         integrator("path") + sky + named("a", xml::bsdf("diffuse") + grey_matter),
         {}},
        {"point", integrator("volpath") + point_light + named("a", tinted), {unmet("'a'", false)}},
        {"spot", integrator("volpath") + spot + named("a", tinted), {unmet("'a'", false)}},
        {"sun and sky", integrator("volpath") + sun + sky + named("a", jade), {}},
        {"simulated, sun", integrator("path") + sun + named("a", simulated), {}},
        {"glass", integrator("volpath") + sun + named("a", glass), {}},
        {"both",
         integrator("volpath") + sun + named("a", glass) + named("b", tinted),
         {unmet("'b'", false)}},
        {"glass, path", integrator("path") + sun + named("a", glass), {unmet("'a'", false, true)}},
        {"glass by recursion", integrator("ray") + sun + named("a", glass), {}},
        {"a lamp in its bulb",
         integrator("path") + lamp_inside + named("a", glass),
         {unmet("'a'", false, true)}},
        {"both kinds",
         integrator("path") + sun + named("a", glass) + named("b", fog),
         {unseen("path", "at 'b'", true), unmet("'a'", false, true)}},
        {"sky", integrator("volpath") + sky + named("a", jade), {}},
        {"fog in the sun", integrator("volpath") + sun + named("a", fog), {}},
        {"a rough boundary", integrator("volpath") + sun + named("a", rough + grey_matter), {}},
        {"thin glass", integrator("path") + sun + named("a", xml::bsdf("thindielectric")), {}},
        {"a technique in the sun", integrator("path") + sun + named("a", marble), {}},
        {"a mirror", integrator("path") + sun + named("a", mirror) + wall, {mirrored("'a'")}},
        {"mirrors in fog",
         integrator("volpath") + spot + named("a", mirror) + named("b", mirror) + named("c", fog),
         {mirrored("'a' and 'b'")}},
        {"glass and mirror",
         integrator("path") + sun + named("a", glass) + named("b", mirror) + wall,
         {unmet("'a'", false, true), mirrored("'b'")}},
        {"a mirror with nothing around", integrator("path") + sun + named("a", mirror), {}},
        {"a mirror under the sky", integrator("path") + sky + named("a", mirror) + wall, {}},
        {"a rough mirror",
         integrator("path") + sun + named("a", xml::bsdf("roughconductor")) + wall,
         {}},
        {"varnish", integrator("path") + sun + named("a", xml::bsdf("plastic")) + wall, {}},
        {"a mirror by recursion", integrator("ray") + sun + named("a", mirror) + wall, {}},
        {"a lamp inside", integrator("volpath") + lamp_inside + named("a", tinted), {}},
    };
    for (const auto& c : cases) {
        const Scene s = scene(c.body);
        EXPECT_EQ(missing_light(s, plan_of(s)), c.said) << c.what;
    }
}

TEST_F(MissingLight, OfTheCamerasMedium) {
    const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                          "<sensor type=\"perspective\"><medium name=\"medium\" "
                          "type=\"homogeneous\">" +
                          grey + "</medium></sensor>\n" + named("a", xml::bsdf("diffuse")));
    EXPECT_EQ(missing_light(s, plan_of(s)),
              std::vector<std::string>{
                  "integrator 'path' does not see the medium around the camera: the picture is as "
                  "if it were not there; use --integrator volpath"});
}

TEST_F(MissingLight, FollowsTheScenesOwnWarnings) {
    Scene s = scene(xml::integrator("path") + xml::constant_light() +
                    named("a", xml::bsdf("null") + grey_matter));
    s.warnings = {"first"};
    const std::vector<std::string> all = warnings_of(s, plan_of(s));
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0], "first");
    EXPECT_EQ(all[1], missing_light(s, plan_of(s))[0]);
}

TEST_F(MissingLight, OfFramesInRealTime) {
    const std::string glass = xml::dielectric(1.5), metal = xml::bsdf("roughconductor"),
                      jade = xml::dielectric(1.5) + grey_matter;
    const auto said = [&](const std::string& body, ColorMode mode = ColorMode::rgb_bands) {
        const Scene s = scene(xml::integrator("path") + body, mode);
        for (const TechniqueDescription* t : techniques())
            if (t->realtime) return missing_light(s, plan_of(s, {std::string(t->name)}));
        return std::vector<std::string>{"built without"};
    };
    const auto some = said(point_light + named("a", jade) + named("b", xml::bsdf("diffuse")));
    if (some[0] == "built without") GTEST_SKIP() << "built without frames in real time";
    const std::string always =
        "frames in real time leave out the light that one surface sends to another";
    EXPECT_EQ(some, std::vector{always});
    EXPECT_EQ(said(point_light + named("a", jade) + named("b", glass) + named("c", metal)),
              std::vector{always + "; 'b' drawn as opaque; 'c' drawn without highlights"});
    EXPECT_EQ(said(point_light + named("a", jade), ColorMode::spectral),
              std::vector{always + "; wavelengths are those of red, green and blue"});
}

TEST_F(MissingLight, MakesNoTruth) {
    const std::string jade = xml::dielectric(1.5) + grey_matter;
    const std::string tinted =
        xml::bsdf("dielectric", xml::number("specular_transmittance", 0.9)) + grey_matter;
    EXPECT_EQ(
        error_of([&] {
            require_lit_insides(scene(xml::integrator("path") + point_light + named("a", tinted)));
        }),
        "complete simulation cannot be the reference: point, spot and directional lights do not "
        "light the inside of 'a' through its smooth boundary, so the truth would lack their light; "
        "use small area lights in their place, a rough boundary, or another reference "
        "(--reference)");
    for (const std::string& lit :
         {xml::constant_light() + named("a", tinted), point_light + named("a", jade),
          lamp_inside + named("a", jade), point_light + vacuum_ball,
          sun + named("a", xml::bsdf("null") + grey_matter)})
        EXPECT_NO_THROW(require_lit_insides(scene(xml::integrator("path") + lit))) << lit;
}

}  // namespace
}  // namespace nacre
