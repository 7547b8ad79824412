// The list of techniques, and the way from what scenes and choices say to one that renders.
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

std::string matter() { return xml::dielectric(eta) + xml::medium("interior", coefficients); }

TEST_F(Techniques, ChooseByName) {
    const Scene s = scene(xml::integrator("volpath") + xml::constant_light() + slab(1, matter()));
    for (const TechniqueDescription* t : techniques()) {
        const RenderPlan plan = plan_of(s, {std::string(t->name)});
        EXPECT_EQ(plan.integrator, t->below ? "path" : t->name);
        EXPECT_EQ(plan.is_simulation(), t->simulates);
        EXPECT_EQ(plan.has_technique(0), !t->simulates);
        EXPECT_NO_THROW(prepare(s, plan)) << t->name;
    }
    EXPECT_EQ(plan_of(s, {"Two Pass"}).shapes[0].technique->name, "two_pass");
    EXPECT_EQ(s.integrator.type, "volpath");
}

TEST_F(Techniques, VariantsAreChoices) {
    const Scene s = scene(xml::integrator("volpath") + xml::constant_light() + slab(1, matter()));
    for (const TechniqueDescription* t : techniques()) {
        const std::vector<TechniqueChoice> variants = variants_of(*t);
        EXPECT_EQ(variants.size(), 1 + std::ranges::count(t->variants, '|')) << t->name;
        for (const TechniqueChoice& v : variants) {
            EXPECT_EQ(v.technique, t->name);
            EXPECT_EQ(checked(v).options, v.options) << t->name;
            const RenderPlan plan = plan_of(s, v);
            EXPECT_NO_THROW(prepare(s, plan)) << t->name << v.option("profile");
            EXPECT_EQ(plan.shapes[0].profile,
                      v.option("profile").empty() ? "dipole" : v.option("profile"));
        }
    }
    TechniqueDescription some = techniques().find("surface");
    some.variants = "a=1 profile=x b=c|profile=y";
    const std::vector<TechniqueChoice> variants = variants_of(some);
    ASSERT_EQ(variants.size(), 2u);
    const std::vector<std::pair<std::string, std::string>> options{
        {"a", "1"}, {"profile", "x"}, {"b", "c"}};
    EXPECT_EQ(variants[0].options, options);
    EXPECT_EQ(variants[1].option("profile"), "y");
    EXPECT_EQ(variants[1].option("a"), "");
    // Two passes by three sizes of groups.
    EXPECT_EQ(variants_of(techniques().find("two_pass")).back().option("error"), "0.05");
}

/// What the scene says, and what a choice says over it.
TEST_F(Techniques, OptionsOfScenesAndChoices) {
    const Scene s = scene(
        xml::integrator("path") + xml::constant_light() +
        slab(1, subsurface("better_dipole", word("method", "Two-Pass") + xml::number("spacing", 3) +
                                                word("free_path", "diffuse") +
                                                xml::integer("irr_samples", 32))) +
        slab(1, matter()) + slab(1, xml::bsdf("diffuse")));
    const RenderPlan own = plan_of(s);
    ASSERT_TRUE(own.has_technique(0));
    EXPECT_FALSE(own.has_technique(1) || own.has_technique(2));
    EXPECT_EQ(own.shapes[0].technique->name, "two_pass");
    EXPECT_EQ(own.shapes[0].profile, "better_dipole");
    EXPECT_EQ(own.shapes[0].options.number("spacing"), 3.);
    EXPECT_EQ(own.shapes[0].options.number("error"), 0.2);
    EXPECT_EQ(own.shapes[0].options.whole("irradiance_samples"), 32);
    // All translucent shapes, and what the choice leaves open as the scene says.
    const RenderPlan chosen =
        plan_of(s, {"two_pass", {{"spacing", "2.5"}, {"points", "repulsion"}}});
    EXPECT_TRUE(chosen.has_technique(0) && chosen.has_technique(1));
    EXPECT_FALSE(chosen.has_technique(2));
    EXPECT_EQ(chosen.shapes[0].options.number("spacing"), 2.5);
    EXPECT_EQ(chosen.shapes[0].options.word("points"), "repulsion");
    EXPECT_EQ(chosen.shapes[0].options.whole("irradiance_samples"), 32);
    EXPECT_EQ(chosen.shapes[1].options.whole("irradiance_samples"), 8);
    EXPECT_EQ(chosen.shapes[1].profile, "dipole");
    // Under whichever name the scene says it.
    const RenderPlan samples = plan_of(s, {"two_pass", {{"irradiance_samples", "64"}}});
    EXPECT_EQ(samples.shapes[0].options.whole("irradiance_samples"), 64);
    // Options of other techniques wait for theirs; the profile stands for the matter.
    const RenderPlan walks = plan_of(s, {"random_walk"});
    EXPECT_EQ(walks.shapes[0].options.word("free_path"), "diffuse");
    EXPECT_EQ(walks.shapes[0].profile, "better_dipole");
    EXPECT_EQ(walks.shapes[1].options.word("free_path"), "transport");
}

TEST_F(Techniques, MistakesInChoicesAreNamed) {
    const struct {
        TechniqueChoice choice;
        const char* message;
    } cases[] = {
        {{"two_pass", {{"spaceing", "1"}}},
         "two_pass: unknown parameter 'spaceing'; did you mean 'spacing'?"},
        {{"two_pass", {{"spacing", "much"}}},
         "two_pass: spacing = 'much' must be a number within [0.01, 100]"},
        {{"two_pass", {{"error", "-1"}}},
         "two_pass: error = -1 is out of range: must lie within [0, 10]"},
        {{"two_pass", {{"irradiance_samples", "1.5"}}},
         "two_pass: irradiance_samples = 1.5 must be a whole number"},
        {{"brdf", {{"exit_fresnel", "normalized"}}},
         "brdf: unknown exit_fresnel 'normalized'; did you mean 'normalised'?"},
        {{"brdf", {{"spacing", "1"}}},
         "brdf: unknown parameter 'spacing'; known are: profile, exit_fresnel"},
        {{"surface", {{"profile", "dipol"}}},
         "surface: unknown profile 'dipol'; did you mean 'dipole'?"},
        {{"two_passes"}, "unknown technique 'two_passes'; did you mean 'two_pass'?"},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of([&] { checked(c.choice); }), c.message);
    const Scene opaque = scene(xml::integrator("path") + slab(1, xml::bsdf("diffuse")));
    EXPECT_EQ(error_of([&] { plan_of(opaque, {"surface"}); }),
              "technique 'surface' has nothing to do: no shape has a homogeneous medium inside "
              "behind a dielectric boundary, smooth or equally rough everywhere, without "
              "dispersion or tint");
}

TEST_F(Techniques, SayWhatTheyCannotDo) {
    const auto message = [&](const std::string& profile, const std::string& options) {
        return error_of([&] {
            const Scene s = scene(xml::integrator("path") + xml::constant_light() +
                                  slab(1, subsurface(profile, options)));
            prepare(s, plan_of(s));
        });
    };
    // The element begins in column 153; a parameter behind it.
    const auto says = [&](const std::string& text, const std::string& place,
                          const std::string& rest) {
        const std::size_t at = text.find(": ");
        EXPECT_EQ(text.substr(0, place.size()), place) << text;
        EXPECT_EQ(text.substr(at + 2), rest);
    };
    says(message("dipole", word("method", "two_passes")), "scene.xml:4:153",
         "unknown technique 'two_passes'; did you mean 'two_pass'?");
    says(message("dipol", word("method", "surface")), "scene.xml:4:153",
         "surface: unknown profile 'dipol'; did you mean 'dipole'?");
    says(message("dipol", word("method", "random_walk")), "scene.xml:4:153",
         "unknown diffusion profile 'dipol'; did you mean 'dipole'?");
    says(message("normalised_diffusion", word("method", "two_pass")), "scene.xml:4:153",
         "two_pass: unknown profile 'normalised_diffusion'; known are: dipole, better_dipole");
    says(message("dipole", xml::number("spaceing", 1)), "scene.xml:4:",
         "<subsurface type=\"dipole\"> has no parameter 'spaceing'; did you mean 'spacing'?");
    says(message("dipole", xml::number("sigma_x", 1)), "scene.xml:4:",
         "<subsurface type=\"dipole\"> has no parameter 'sigma_x'; did you mean 'sigma_s'?");
    says(message("dipole", word("method", "brdf") + xml::number("spacing", 0)),
         "scene.xml:4:", "two_pass: spacing = 0 is out of range: must lie within [0.01, 100]");
    says(message("dipole", word("points", "repulsive")),
         "scene.xml:4:", "two_pass: unknown points 'repulsive'; did you mean 'repulsion'?");
    // Of several shapes: the message behind the place.
    const auto of_scene = [&](const std::string& shapes) {
        const std::string text = error_of([&] {
            const Scene s = scene(xml::integrator("path") + xml::constant_light() + shapes);
            prepare(s, plan_of(s));
        });
        return text.substr(text.find(": ") + 2);
    };
    EXPECT_EQ(of_scene(xml::shape("rectangle", subsurface("dipole", ""))),
              "'rectangle' is flat: it has no inside for light to be scattered in; give it a "
              "thickness");
    const std::string brdf = slab(1, subsurface("dipole", word("method", "brdf"))),
                      volpath = slab(1, subsurface("dipole", word("method", "volpath")));
    for (const std::string& both : {brdf + volpath, volpath + brdf})
        EXPECT_EQ(of_scene(both),
                  "'volpath' simulates the whole scene: give all translucent shapes this method, "
                  "or none");
}

}  // namespace
}  // namespace nacre
