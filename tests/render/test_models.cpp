// Renders with the reflectance models: material samples, light samples and both together see the
// same radiance. A model whose value, sampling and density do not belong together shows here as a
// difference between material samples and the others.
#include "nacre/reflectance/registry.h"
#include "nacre/render/path_tracer.h"
#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

/// Smooth enough to be told from a diffuse surface, rough enough for light samples to find; colours
/// that differ, so that no channel stands for the others.
struct Case {
    const char* model;
    const char* settings;
};
constexpr Case cases[] = {
    {"lambert", "reflectance=0.8,0.5,0.2"},
    {"oren_nayar", "variant=full reflectance=0.8,0.5,0.2 sigma=0.6"},
    {"oren_nayar", "variant=qualitative reflectance=0.8,0.5,0.2 sigma=0.6"},
    {"eon", "reflectance=0.8,0.5,0.2 roughness=0.7"},
    {"phong", "variant=modified kd=0.4,0.2,0.1 ks=0.5 n=20"},
    {"phong", "variant=classic kd=0.4,0.2,0.1 ks=0.5 n=20"},
    {"blinn_phong", "kd=0.4,0.2,0.1 ks=0.5 n=30"},
    {"torrance_sparrow", "kd=0.4,0.2,0.1 ks=0.6 m=0.3 n=1.8"},
    {"blinn_torrance_sparrow", "kd=0.4,0.2,0.1 ks=0.5 distribution=phong beta=20 n=1.8"},
    {"cook_torrance", "kd=0.3,0.2,0.1 ks=0.7 distribution=beckmann m=0.3 n=1.8"},
    {"cook_torrance",
     "kd=0 ks=1 distribution=beckmann terms=2 w1=0.4 m=0.2 w2=0.6 m2=0.4 n=0.2 k=3"},
    {"ggx", "ks=0.9 alpha_u=0.25 alpha_v=0.5 fresnel=schlick f0=0.9,0.6,0.3"},
    {"ggx", "ks=1 alpha=0.5 compensation=kulla_conty fresnel=schlick f0=0.9,0.6,0.3"},
    {"metallic_roughness", "base_color=0.8,0.5,0.3 metallic=0.4 roughness=0.4 coupling=shirley"},
    {"ward", "variant=gmd kd=0.3,0.2,0.1 ks=0.6 alpha_u=0.2 alpha_v=0.4"},
    {"ward", "variant=duer kd=0.3,0.2,0.1 ks=0.4 alpha=0.25"},
    {"schlick", ""},
    {"schlick_ct", "kd=0.2,0.1,0.05 f0=0.5 m=0.4"},
    {"he_torrance", "sigma0=0.18 tau=1.5"},
    {"lafortune", "kd=0.3,0.2,0.1 ks=0.6 n=8 cx=0.9 cy=0.9 cz=0.9"},
    {"lafortune", "kd=0 ks=0.7,0.5,0.3 cx=-0.6 cxy=0.2 cxz=0.1 cz=0.8 n=6"},
    {"poulin_fournier", "kd=0.3,0.2,0.1 ks=0.6 n=40 spacing=2.4 depth=0.7"},
    {"poulin_fournier", "profile=grooved kd=0.3,0.2,0.1 ks=0.6 n=40 spacing=2.4 depth=0.7"},
};

class ModelRenders : public RenderTest {
  protected:
    static std::string material(const Case& c) {
        std::string inside;
        const ModelDescription& model = find_evaluator(c.model).description();
        for (const Setting& s : parse_settings(c.settings)) {
            const int position = find_parameters(model.name, model.parameters, s.name).front();
            const ParameterKind kind = model.parameters[std::size_t(position)].kind;
            if (const auto* word = std::get_if<std::string>(&s.value))
                inside += fmt::format("<string name=\"{}\" value=\"{}\"/>", s.name, *word);
            else if (const auto* color = std::get_if<Vec3f>(&s.value))
                inside += xml::rgb(s.name, Vec3d(*color));
            else if (kind == ParameterKind::integer)
                inside += xml::integer(s.name, int(std::get<double>(s.value)));
            else
                inside += xml::number(s.name, std::get<double>(s.value));
        }
        return xml::bsdf(c.model, inside);
    }
    /// A sphere of the material on a diffuse floor, so that light also comes from below it and
    /// paths meet the material more than once.
    static std::string stage(const Case& c) {
        return xml::sphere({}, 1, material(c)) +
               xml::shape("rectangle",
                          "<transform name=\"to_world\"><scale value=\"4\"/>"
                          "<rotate x=\"1\" angle=\"-90\"/><translate y=\"-1.2\"/></transform>" +
                              xml::bsdf("diffuse", xml::number("reflectance", 0.6)));
    }
    void check(int pixels, double largest_error) {
        // Large enough for material samples to find.
        const std::pair<const char*, std::string> lights[] = {
            {"area light", xml::shape("rectangle",
                                      "<transform name=\"to_world\"><scale value=\"1.5\"/>"
                                      "<rotate x=\"1\" angle=\"90\"/><translate y=\"2.5\"/>"
                                      "</transform>" +
                                          xml::area_light({3, 2, 1}))},
            {"constant light", xml::constant_light()}};
        const double deviations =
            sidak_deviations(6 * static_cast<int>(std::size(cases) * std::size(lights)));
        const RayMaker rays = ray_bundle({0.4f, 2.f, 4.f}, {-0.1f, -0.5f, -1.f}, 1.f);
        for (const Case& c : cases)
            for (const auto& [light, light_text] : lights) {
                const std::string what = fmt::format("{} {}, {}", c.model, c.settings, light);
                const Scene s = scene(xml::integrator("path", xml::integer("max_depth", 4)) +
                                      stage(c) + light_text);
                using E = PathTracer::Estimators;
                std::vector<RadianceEstimate> e;
                std::uint64_t seed = 1;
                for (const E which : {E::both, E::material_only, E::light_only})
                    e.push_back(estimate(s, PathTracer(s, false, which), rays,
                                         {.pixels = pixels, .seed = seed++}));
                expect_agreement(e[0], e[1], deviations, what + ", both and material");
                expect_agreement(e[0], e[2], deviations, what + ", both and light");
                for (const RadianceEstimate& one : e)
                    EXPECT_LT(one.error[1], largest_error * one.mean[1]) << what;
            }
    }
};

TEST_F(ModelRenders, EveryModelIsAmongTheCases) {
    for (const ModelDescription* m : models())
        EXPECT_TRUE(std::any_of(std::begin(cases), std::end(cases), [&](const Case& c) {
            return m->name == c.model;
        })) << m->name;
}

TEST_F(ModelRenders, MaterialAndLightSamplesAgree) { check(400, 0.06); }

using LongModelRenders = ModelRenders;
TEST_F(LongModelRenders, MaterialAndLightSamplesAgree) { check(20000, 0.01); }

}  // namespace
}  // namespace nacre
