// Frames against complete simulation. What differs is the profile's doing (a half space of the same
// matter in place of the object) and what lights do not see; the bounds are what the literature and
// the offline techniques with the same profile lead one to expect, not what we happen to make.
#include "nacre/render/render.h"
#include "tests/realtime/frames.h"

namespace nacre {

const TechniqueDescription& translucent_shadow_map_technique();

namespace {

class AgainstSimulation : public Frames {
  protected:
    static constexpr int blocks = 16, side = 256;

    /// Mean radiance in blocks of a frame of 256 x 256.
    std::vector<double> frame(const Scene& s, const TechniqueDescription& technique) {
        FrameRenderer renderer(gpu(), s, shapes_of(s, technique));
        FilmSettings film = s.film;
        film.width = film.height = side;
        film.crop_width = 0;
        const View view = camera_view(*s.camera, film, {0.f, 0.f}, renderer.scene().bounds());
        const std::vector<float> rgba =
            renderer.render(view, {.light_points = 2, .light_view = 256}).read();
        std::vector<double> means(std::size_t(3 * blocks * blocks));
        constexpr int block = side / blocks;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (int c = 0; c < 3; ++c)
                    means[std::size_t(3 * (y / block * blocks + x / block) + c)] +=
                        rgba[std::size_t(4 * (side * y + x) + c)] / double(block * block);
        return means;
    }
    /// RMS deviation of the blocks from complete simulation, over the simulation's RMS, less what
    /// of it is the simulation's noise.
    double deviation(const Scene& s, const TechniqueDescription& technique) {
        const Film truth = render(s, *make_integrator(s, "volpath"), FrameSettings::of(s)).film;
        const std::vector<double> ours = frame(s, technique);
        double squares = 0, noise = 0, reference = 0;
        for (int y = 0; y < blocks; ++y)
            for (int x = 0; x < blocks; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double t = truth.mean(x, y)[std::size_t(c)];
                    const double d = ours[std::size_t(3 * (y * blocks + x) + c)] - t;
                    squares += d * d;
                    noise += truth.sample_variance(x, y)[std::size_t(c)] / truth.count(x, y);
                    reference += t * t;
                }
        return std::sqrt(std::max(0., squares - noise) / reference);
    }
    /// Marble (Jensen et al. 2001, table 1) without a boundary, so that no mirror images count.
    static std::string marble() {
        return xml::bsdf("null") +
               xml::medium("interior", xml::rgb("sigma_s", {2.19, 2.62, 3.00}) +
                                           xml::rgb("sigma_a", {0.0021, 0.0041, 0.0071}) +
                                           xml::phase("isotropic"));
    }
    Scene look_at(const std::string& body, const Vec3d& lamp) {
        return scene(xml::integrator("volpath") +
                     sensor({0, 12, 80}, {0, 0, 0}, blocks, blocks, 30,
                            "<sampler type=\"independent\"><integer name=\"sample_count\" "
                            "value=\"64\"/></sampler>") +
                     xml::sphere(lamp, 8, xml::area_light({30, 30, 30})) + body);
    }
};

/// 25 %: the dipole alone is wrong by 5 to 15 % on such objects (`two_pass`, docs/benchmarks.md: 13
/// % systematic over the suite), and the lamp, 8 mm wide at 80, is two points.
TEST_F(AgainstSimulation, TranslucentShadowMaps) {
    const struct {
        const char* name;
        std::string body;
        Vec3d lamp;
        double bound;
    } cases[] = {
        {"ball, from the front", xml::sphere({0, 0, 0}, 15, marble()), {-40, 50, 70}, 0.25},
        {"ball, from the side", xml::sphere({0, 0, 0}, 15, marble()), {-80, 20, 0}, 0.25},
        // The kernel takes the sheet for a half space: 0.87 to 0.97 of the slab's closed form at 1
        // to 2 mm (realtime.md), less for what leaves to the other side and comes back.
        {"sheet of 2 mm, from behind",
         xml::shape("cube",
                    "<transform name=\"to_world\"><scale x=\"15\" y=\"15\" z=\"1\"/>"
                    "</transform>" +
                        xml::flag("face_normals", true) + marble()),
         {60, 70, -60},
         0.3}};
    for (const auto& c : cases) {
        const double d = deviation(look_at(c.body, c.lamp), translucent_shadow_map_technique());
        RecordProperty(c.name, fmt::format("{:.3f}", d));
        EXPECT_LT(d, c.bound) << c.name;
    }
}

}  // namespace
}  // namespace nacre
