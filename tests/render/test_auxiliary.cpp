#include "nacre/render/auxiliary.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/render/render_fixture.h"

namespace nacre {
namespace {

class Auxiliary : public RenderTest {
  protected:
    /// A camera at the origin that sees 90 degrees along -z, and what `shapes` says.
    Scene seen(const std::string& shapes, int side = 1, const std::string& integrator = "path") {
        return scene(fmt::format(R"(<integrator type="{}"/>
            <sensor type="perspective">
                <float name="fov" value="90"/>
                <transform name="to_world">
                    <lookat origin="0, 0, 0" target="0, 0, -1" up="0, 1, 0"/>
                </transform>
                <sampler type="sobol"><integer name="sample_count" value="16"/></sampler>
                <film type="hdrfilm">
                    <integer name="width" value="{}"/>
                    <integer name="height" value="{}"/>
                    <rfilter type="box"/>
                </film>
            </sensor>)",
                                 integrator, side, side) +
                     shapes);
    }
    /// Of a narrow view along -z alone, where Fresnel's share is that of normal incidence.
    Scene seen_ahead(const std::string& shapes, const std::string& integrator = "path") {
        Scene all = seen(shapes, 101, integrator);
        all.film.crop_x = all.film.crop_y = 50;
        all.film.crop_width = all.film.crop_height = 1;
        return all;
    }
};

/// A rectangle at z = -2 that fills the view and faces the camera.
std::string wall(const std::string& inside, double z = -2) {
    return fmt::format(R"(<shape type="rectangle"><transform name="to_world">
            <scale value="100"/><translate z="{}"/></transform>{}</shape>)",
                       z, inside);
}

AuxiliaryImages auxiliary_of(const Scene& made) {
    return render_auxiliary(made, FrameSettings::of(made));
}

const std::string red =
    R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.2, 0.1"/></bsdf>)";

TEST_F(Auxiliary, LambertPlaneHasItsReflectanceNormalAndDistance) {
    const Scene made = seen(wall(red), 33);
    const AuxiliaryImages images = auxiliary_of(made);
    EXPECT_EQ(images.samples, 16);
    for (const int x : {3, 16, 30}) {
        const Vec3f albedo = images.albedo.mean(x, 16), normal = images.normal.mean(x, 16);
        EXPECT_NEAR(albedo.x, 0.7f, 1e-6f);
        EXPECT_NEAR(albedo.y, 0.2f, 1e-6f);
        EXPECT_NEAR(albedo.z, 0.1f, 1e-6f);
        EXPECT_NEAR(images.albedo.sample_variance(x, 16).x, 0.f, 1e-12f);
        EXPECT_NEAR(normal.z, 1.f, 1e-6f);
        // Of the ray at tangent t along x: 2 sqrt(1 + t^2), a pixel's mean off by less than its size.
        const double t = (x + 0.5) / 33 * 2 - 1;
        EXPECT_NEAR(images.depth.mean(x, 16).x, 2 * std::sqrt(1 + t * t), 0.01);
    }
}

TEST_F(Auxiliary, WallSeenFromBehindFacesTheViewer) {
    const Scene made = seen(
        R"(<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/>
           <scale value="100"/><translate z="-2"/></transform>
           <bsdf type="twosided">)" +
        red + "</bsdf></shape>");
    EXPECT_NEAR(auxiliary_of(made).normal.mean(0, 0).z, 1.f, 1e-6f);
}

TEST_F(Auxiliary, MirrorShowsWhatIsSeenInIt) {
    // Behind the camera a red wall, before it a mirror.
    const Scene made =
        seen(wall(R"(<bsdf type="conductor"><string name="material" value="none"/></bsdf>)") +
             R"(<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/>
           <scale value="1000"/><translate z="3"/></transform>)" +
             red + "</shape>");
    const AuxiliaryImages images = auxiliary_of(made);
    EXPECT_NEAR(images.albedo.mean(0, 0).x, 0.7f, 1e-5f);
    EXPECT_NEAR(images.normal.mean(0, 0).z, -1.f, 1e-5f);
    // The mirror's own, between the middle of the pixel and its corner.
    EXPECT_GT(images.depth.mean(0, 0).x, 2.f);
    EXPECT_LT(images.depth.mean(0, 0).x, 2.f * std::sqrt(3.f));
}

TEST_F(Auxiliary, ClearSlabBlendsWhatItMirrorsAndWhatLiesBehind) {
    // A narrow view, so that Fresnel's share is that of normal incidence: 0.04 at the first side.
    const Scene made = seen_ahead(
        R"(<shape type="cube"><transform name="to_world"><scale x="50" y="50" z="0.5"/>
           <translate z="-3"/></transform><bsdf type="dielectric">
           <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>)" +
        wall(red, -9) + R"(<emitter type="constant"><rgb name="radiance" value="0.5, 5, 0"/>
        </emitter>)");
    const AuxiliaryImages images = auxiliary_of(made);
    const Vec3f albedo = images.albedo.mean(0, 0);
    EXPECT_NEAR(albedo.x, 0.04 * 0.5 + 0.96 * 0.7, 1e-3);
    EXPECT_NEAR(albedo.y, 0.04 * 1 + 0.96 * 0.2, 1e-3);  // radiance counts as 1 at most
    EXPECT_NEAR(images.normal.mean(0, 0).z, 0.96, 1e-3);
    EXPECT_NEAR(images.depth.mean(0, 0).x, 2.5, 1e-3);
}

TEST_F(Auxiliary, TranslucentObjectHasItsSurfacesNormalAndItsMediumsColour) {
    const Scene made = seen_ahead(
        R"(<shape type="cube"><transform name="to_world"><scale x="50" y="50" z="20"/>
           <translate z="-23"/></transform><bsdf type="dielectric">
           <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>
           <medium type="homogeneous" name="interior"><float name="sigma_t" value="10"/>
           <rgb name="albedo" value="0.9, 0.8, 0.7"/></medium></shape>)",
        "volpath");
    const AuxiliaryImages images = auxiliary_of(made);
    EXPECT_NEAR(images.albedo.mean(0, 0).x, 0.96 * 0.9, 1e-3);
    EXPECT_NEAR(images.albedo.mean(0, 0).z, 0.96 * 0.7, 1e-3);
    EXPECT_NEAR(images.normal.mean(0, 0).z, 1, 1e-4);
}

TEST_F(Auxiliary, ThinFogShowsItsAlbedoByTheShareThatItTakesAway) {
    // 1 - exp(-0.2 * 3) of the ray, 3 units deep, before a red wall.
    const Scene made = seen_ahead(
        R"(<shape type="cube"><transform name="to_world"><scale x="50" y="50" z="1.5"/>
           <translate z="-3"/></transform><bsdf type="null"/>
           <medium type="homogeneous" name="interior"><float name="sigma_t" value="0.2"/>
           <rgb name="albedo" value="0.5, 0.5, 0.5"/></medium></shape>)" +
            wall(red, -9),
        "volpath");
    const AuxiliaryImages images = auxiliary_of(made);
    const double passing = std::exp(-0.6);
    EXPECT_NEAR(images.albedo.mean(0, 0).x, (1 - passing) * 0.5 + passing * 0.7, 1e-3);
    EXPECT_NEAR(images.normal.mean(0, 0).z, passing, 1e-3);
    EXPECT_NEAR(images.depth.mean(0, 0).x, 9, 1e-2);  // fog is no surface
}

TEST_F(Auxiliary, BackgroundIsItsRadianceWithoutNormalAndDepth) {
    const Scene made =
        seen(R"(<emitter type="constant"><rgb name="radiance" value="0.25, 0.5, 7"/></emitter>)");
    const AuxiliaryImages images = auxiliary_of(made);
    EXPECT_EQ(images.albedo.mean(0, 0), Vec3f(0.25f, 0.5f, 1.f));
    EXPECT_EQ(images.normal.mean(0, 0), Vec3f(0, 0, 0));
    EXPECT_EQ(images.depth.mean(0, 0).x, 0.f);
}

TEST_F(Auxiliary, ChannelsHaveTheirNamesAndTheFilmsValues) {
    const Scene made = seen(wall(red), 3);
    const AuxiliaryImages images = auxiliary_of(made);
    Image picture(3, 3);
    picture.at(1, 2, 1) = 5.f;
    picture.metadata["nacre.seed"] = "4";
    add_auxiliary_channels(picture, images);
    const std::vector<std::string> names{"R",
                                         "G",
                                         "B",
                                         "albedo.R",
                                         "albedo.G",
                                         "albedo.B",
                                         "normal.X",
                                         "normal.Y",
                                         "normal.Z",
                                         "depth.Z",
                                         "variance.albedo.R",
                                         "variance.albedo.G",
                                         "variance.albedo.B",
                                         "variance.normal.X",
                                         "variance.normal.Y",
                                         "variance.normal.Z",
                                         "variance.depth.Z"};
    EXPECT_EQ(picture.channels, names);
    EXPECT_EQ(picture.metadata["nacre.seed"], "4");
    EXPECT_EQ(picture.metadata["nacre.auxiliary_samples"], "16");
    EXPECT_EQ(picture.at(1, 2, 1), 5.f);
    EXPECT_EQ(picture.at(2, 0, picture.channel("albedo.G")), images.albedo.mean(2, 0).y);
    EXPECT_EQ(picture.at(2, 0, picture.channel("normal.Z")), images.normal.mean(2, 0).z);
    EXPECT_EQ(picture.at(2, 0, picture.channel("depth.Z")), images.depth.mean(2, 0).x);
    EXPECT_EQ(picture.at(2, 0, picture.channel("variance.depth.Z")),
              images.depth.sample_variance(2, 0).x);
}

TEST_F(Auxiliary, SameBitsForAnyNumberOfThreadsAndInACropWindow) {
    Scene made = seen(wall(R"(<bsdf type="plastic"/>)") + R"(<emitter type="constant"/>)", 20);
    const auto with = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        std::size_t(threads));
        return auxiliary_of(made);
    };
    const AuxiliaryImages one = with(1), four = with(4);
    made.film.crop_x = 5, made.film.crop_y = 7, made.film.crop_width = 9, made.film.crop_height = 4;
    const AuxiliaryImages part = with(2);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 9; ++x) {
            EXPECT_EQ(one.albedo.mean(x + 5, y + 7), four.albedo.mean(x + 5, y + 7));
            EXPECT_EQ(one.albedo.mean(x + 5, y + 7), part.albedo.mean(x, y));
            EXPECT_EQ(one.depth.mean(x + 5, y + 7), part.depth.mean(x, y));
        }
}

TEST_F(Auxiliary, StopsWhenAsked) {
    const Scene made = seen(wall(red));
    const std::atomic<bool> stop{true};
    EXPECT_THROW(render_auxiliary(made, FrameSettings::of(made),
                                  Work(&stop, Work::Clock::time_point::max(), {})),
                 Stopped);
}

}  // namespace
}  // namespace nacre
