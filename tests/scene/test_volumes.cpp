#include <cstring>

#include "nacre/math/random.h"
#include "nacre/scene/media/volume_grid.h"
#include "tests/scene/bands.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

std::shared_ptr<VoxelGrid> grid(int nx, int ny, int nz, int channels = 1) {
    auto g = std::make_shared<VoxelGrid>();
    g->nx = nx, g->ny = ny, g->nz = nz, g->channels = channels;
    g->data.resize(std::size_t(nx) * ny * nz * channels);
    return g;
}
/// Values f(x, y, z) at the centres of the voxels, coordinates in the unit cube.
template <class F>
std::shared_ptr<VoxelGrid> sampled(int nx, int ny, int nz, F&& f) {
    auto g = grid(nx, ny, nz);
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                g->data[(std::size_t(z) * ny + y) * nx + x] =
                    f((x + 0.5f) / nx, (y + 0.5f) / ny, (z + 0.5f) / nz);
    return g;
}
float at(const VolumePtr& volume, const Point3f& p) { return volume->eval(p, bands)[1]; }
float random_in(Random& r, float a, float b) { return a + (b - a) * r.next(); }

const auto linear = [](float x, float y, float z) { return 1.f + 2.f * x + 3.f * y + 5.f * z; };

TEST(GridVolume, TrilinearFilterIsExactOnLinearFields) {
    const VolumePtr v = make_grid_volume(sampled(5, 7, 9, linear), {}, "grid");
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        // Between the outermost centres; further out values are clamped.
        const Point3f p{random_in(random, 0.1f, 0.9f), random_in(random, 1 / 14.f, 13 / 14.f),
                        random_in(random, 1 / 18.f, 17 / 18.f)};
        EXPECT_NEAR(at(v, p), linear(p.x, p.y, p.z), 1e-5f);
    }
    EXPECT_NEAR(at(v, {0.f, 0.5f, 0.5f}), linear(0.1f, 0.5f, 0.5f), 1e-5f);
    EXPECT_NEAR(at(v, {1.f, 1.f, 1.f}), linear(0.9f, 13 / 14.f, 17 / 18.f), 1e-5f);
}

TEST(GridVolume, IsAffinelyPlacedAndZeroOutside) {
    GridVolumeOptions options;
    options.to_world = Transform::translate({1, 2, 3}) * Transform::rotate({1, 1, 0}, 40) *
                       Transform::scale({2, 3, 0.5});
    const VolumePtr v = make_grid_volume(sampled(8, 8, 8, linear), options, "grid");
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Point3f local{random_in(random, 0.1f, 0.9f), random_in(random, 0.1f, 0.9f),
                            random_in(random, 0.1f, 0.9f)};
        EXPECT_NEAR(at(v, options.to_world.point(local)), linear(local.x, local.y, local.z), 1e-4f);
    }
    for (const Point3f& local : {Point3f(-0.01f, 0.5f, 0.5f),
                                 {0.5f, 1.01f, 0.5f},
                                 {0.5f, 0.5f, -0.05f},
                                 {0.5f, 0.5f, 1e8f}}) {
        EXPECT_EQ(at(v, options.to_world.point(local)), 0.f);
    }
    const Box3f box = v->bounds();
    for (const Point3f& corner : {Point3f(0, 0, 0), {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}) {
        const Point3f p = options.to_world.point(corner);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(p[i], box.lower[i] - 1e-5f);
            EXPECT_LE(p[i], box.upper[i] + 1e-5f);
        }
    }
}

TEST(GridVolume, AnAlbedoGoesOnOutside) {
    auto g = grid(4, 1, 1);
    g->data = {0.1f, 0.2f, 0.3f, 0.4f};
    GridVolumeOptions options;
    options.role = ColorRole::reflectance;
    struct Case {
        VolumeWrap wrap;
        float x, value;
    };
    for (const Case& c : {Case{VolumeWrap::clamp, -2.f, 0.1f},
                          {VolumeWrap::clamp, 7.f, 0.4f},
                          {VolumeWrap::repeat, 1.125f, 0.1f},
                          {VolumeWrap::repeat, -0.375f, 0.3f},
                          {VolumeWrap::repeat, 0.f, 0.25f},
                          {VolumeWrap::repeat, 2.f, 0.25f},
                          {VolumeWrap::mirror, 1.125f, 0.4f},
                          {VolumeWrap::mirror, -0.375f, 0.2f},
                          {VolumeWrap::mirror, 2.125f, 0.1f},
                          {VolumeWrap::mirror, 0.f, 0.1f}}) {
        options.wrap = c.wrap;
        EXPECT_NEAR(at(make_grid_volume(g, options, "grid"), {c.x, 0.5f, 0.5f}), c.value, 1e-6f)
            << int(c.wrap) << " " << c.x;
    }
}

TEST(GridVolume, NearestFilterTakesTheVoxelItself) {
    auto g = grid(4, 1, 1);
    g->data = {1.f, 2.f, 3.f, 4.f};
    GridVolumeOptions options;
    options.filter = VolumeFilter::nearest;
    const VolumePtr v = make_grid_volume(g, options, "grid");
    for (const auto& [x, value] :
         {std::pair{0.f, 1.f}, {0.24f, 1.f}, {0.26f, 2.f}, {0.74f, 3.f}, {1.f, 4.f}})
        EXPECT_EQ(at(v, {x, 0.5f, 0.5f}), value);
}

TEST(GridVolume, BoundsInsideBoxesHold) {
    Random random(3);
    for (const VolumeWrap wrap : {VolumeWrap::clamp, VolumeWrap::repeat, VolumeWrap::mirror})
        for (const ColorRole role : {ColorRole::unbounded, ColorRole::reflectance}) {
            auto g = grid(37, 20, 9);
            for (float& x : g->data)
                x = random.next() < 0.02f ? random.next() : 0.01f * random.next();
            GridVolumeOptions options;
            options.wrap = wrap;
            options.role = role;
            options.to_world = Transform::rotate({0, 1, 1}, 25) * Transform::scale({4, 2, 1});
            const VolumePtr v = make_grid_volume(g, options, "grid");
            int tighter = 0;
            for (int i = 0; i < 300; ++i) {
                Box3f box;
                const Point3f centre = options.to_world.point({random_in(random, -0.2f, 1.2f),
                                                               random_in(random, -0.2f, 1.2f),
                                                               random_in(random, -0.2f, 1.2f)});
                const float size = random_in(random, 0.f, 0.5f);
                box.extend(centre);
                box.extend(centre + Vec3f(size, size * random.next(), size * random.next()));
                const float bound = v->max_in(box);
                EXPECT_LE(bound, v->max());
                tighter += bound < 0.9f * v->max();
                for (int k = 0; k < 200; ++k)
                    EXPECT_LE(at(v, {random_in(random, box.lower.x, box.upper.x),
                                     random_in(random, box.lower.y, box.upper.y),
                                     random_in(random, box.lower.z, box.upper.z)}),
                              bound * 1.000001f);
            }
            // Boxes that reach over an edge bound the whole axis if the grid repeats.
            EXPECT_GT(tighter, wrap == VolumeWrap::clamp ? 50 : 5);
        }
}

TEST(GridVolume, ColoursAreBandsOrSmoothSpectra) {
    auto g = grid(2, 2, 2, 3);
    for (int i = 0; i < 8; ++i) {
        const float rgb[3] = {0.9f, 0.5f, 0.2f};
        std::memcpy(&g->data[3 * i], rgb, sizeof rgb);
    }
    const Wavelengths nm = Wavelengths::at({430.f, 510.f, 590.f, 670.f});
    for (const ColorRole role : {ColorRole::reflectance, ColorRole::unbounded}) {
        GridVolumeOptions options;
        options.role = role;
        const VolumePtr v = make_grid_volume(g, options, "grid");
        const Spectral c = v->eval({0.4f, 0.3f, 0.6f}, bands);
        EXPECT_NEAR(c[0], 0.9f, 1e-6f);
        EXPECT_NEAR(c[2], 0.2f, 1e-6f);
        const SpectrumPtr spectrum = role == ColorRole::reflectance
                                         ? make_rgb_reflectance({0.9f, 0.5f, 0.2f})
                                         : make_rgb_unbounded({0.9f, 0.5f, 0.2f});
        const Spectral s = v->eval({0.4f, 0.3f, 0.6f}, nm);
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(s[i], spectrum->eval(nm)[i], 1e-5f);
            EXPECT_LE(s[i], v->max());
        }
    }
}

TEST(GridVolume, WrongValuesAreNamed) {
    const auto error = [](float value, ColorRole role) -> std::string {
        auto g = grid(3, 4, 5);
        g->data[(std::size_t(4) * 4 + 2) * 3 + 1] = value;
        GridVolumeOptions options;
        options.role = role;
        try {
            make_grid_volume(g, options, "fog.vol");
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    EXPECT_EQ(
        error(-2.f, ColorRole::unbounded),
        "fog.vol: voxel (1, 2, 4) has the value -2; a coefficient must be finite and at least 0");
    EXPECT_EQ(
        error(std::nanf(""), ColorRole::unbounded),
        "fog.vol: voxel (1, 2, 4) has the value nan; a coefficient must be finite and at least 0");
    EXPECT_EQ(error(1.5f, ColorRole::reflectance),
              "fog.vol: voxel (1, 2, 4) has the value 1.5; an albedo must lie within [0, 1]");
    EXPECT_EQ(error(1.5f, ColorRole::unbounded), "no error");
}

/// A .vol file as its documentation lays it out.
struct VolFile {
    char version = 3;
    std::int32_t encoding = 1, n[3] = {2, 3, 4}, channels = 1;
    float box[6] = {-1, 0, 2, 1, 6, 4};
    std::vector<float> values;

    VolFile() {
        for (int i = 0; i < 24; ++i) values.push_back(float(i));
    }
    std::string bytes() const {
        std::string out = "VOL";
        out += version;
        const auto put = [&](const void* p, std::size_t size) {
            out.append(static_cast<const char*>(p), size);
        };
        put(&encoding, 4), put(n, 12), put(&channels, 4), put(box, 24);
        put(values.data(), 4 * values.size());
        return out;
    }
};

class VolFiles : public SceneFiles {
  protected:
    VolumePtr volume(const std::string& parameters, ColorRole role = ColorRole::unbounded) {
        const SceneNodePtr root = read(
            "<medium type=\"heterogeneous\"><volume name=\"sigma_t\" type=\"gridvolume\">"
            "<string name=\"filename\" value=\"fog.vol\"/>" +
            parameters + "</volume></medium>");
        context_.search_path = {folder_};
        return make_volume(*root->children.at(0).node->children.at(0).node, role, context_);
    }
    BuildContext context_;
};

TEST_F(VolFiles, FillTheUnitCubeOrTheirOwnBox) {
    write("fog.vol", VolFile().bytes());
    // Voxel (1, 2, 3) holds ((3 * 3) + 2) * 2 + 1 = 23, voxel (0, 1, 0) holds 2.
    EXPECT_NEAR(at(volume(""), {0.75f, 5 / 6.f, 7 / 8.f}), 23.f, 1e-4f);
    EXPECT_NEAR(at(volume(""), {0.25f, 0.5f, 1 / 8.f}), 2.f, 1e-4f);
    const VolumePtr boxed = volume(
        "<boolean name=\"use_grid_bbox\" value=\"true\"/><transform "
        "name=\"to_world\"><translate x=\"10\"/></transform>");
    EXPECT_NEAR(at(boxed, {10.5f, 5.f, 3.75f}), 23.f, 1e-4f);
    EXPECT_EQ(boxed->bounds().lower, Point3f(9.f, 0.f, 2.f));
    EXPECT_EQ(boxed->bounds().upper, Point3f(11.f, 6.f, 4.f));
    EXPECT_EQ(boxed->max(), 23.f);
}

TEST_F(VolFiles, FeedHeterogeneousMedia) {
    write("fog.vol", VolFile().bytes());
    const SceneNodePtr root = read(
        "<medium type=\"heterogeneous\"><volume name=\"sigma_t\" type=\"gridvolume\"><string "
        "name=\"filename\" value=\"fog.vol\"/></volume><rgb name=\"albedo\" value=\"0.5, 0.25, "
        "1\"/><float name=\"scale\" value=\"2\"/></medium>");
    context_.search_path = {folder_};
    const MediumPtr medium = make_medium(*root->children.at(0).node, context_);
    EXPECT_FALSE(medium->homogeneous());
    const MediumCoefficients c = medium->coefficients({0.75f, 5 / 6.f, 7 / 8.f}, bands);
    EXPECT_NEAR(c.sigma_t[1], 46.f, 1e-3f);
    EXPECT_NEAR(c.sigma_s[1], 11.5f, 1e-3f);
    EXPECT_NEAR(medium->majorant(bands)[0], 46.f, 1e-3f);
    EXPECT_EQ(medium->coefficients({2.f, 0.f, 0.f}, bands).sigma_t[0], 0.f);
}

TEST_F(VolFiles, DamageIsExplained) {
    const auto error = [&](auto&& damage) {
        VolFile file;
        damage(file);
        write("fog.vol", file.bytes());
        return error_of([&] { volume(""); });
    };
    const std::string cut =
        " cells of 1 float32 after a header of 48 bytes; it was cut off or damaged";
    EXPECT_EQ(error([](VolFile& f) { f.values.pop_back(); }),
              "fog.vol: is 140 bytes long, which does not fit 2 x 3 x 4" + cut);
    EXPECT_EQ(error([](VolFile& f) { f.values.push_back(0.f); }),
              "fog.vol: is 148 bytes long, which does not fit 2 x 3 x 4" + cut);
    // Numbers whose product overflows 64 bits.
    EXPECT_EQ(
        error([](VolFile& f) { f.n[0] = f.n[1] = f.n[2] = 2147483647; }),
        "fog.vol: is 144 bytes long, which does not fit 2147483647 x 2147483647 x 2147483647" +
            cut);
    EXPECT_EQ(error([](VolFile& f) { f.n[1] = -3; }),
              "fog.vol: has a side of -3 cells; at least 1 is needed");
    EXPECT_EQ(error([](VolFile& f) { f.version = 2; }),
              "fog.vol: has version 2 of the format; only version 3 is read");
    EXPECT_EQ(error([](VolFile& f) { f.encoding = 3; }),
              "fog.vol: stores values by encoding 3; only 1 (float32) is read");
    EXPECT_EQ(error([](VolFile& f) { f.channels = 6; }),
              "fog.vol: has 6 channels; only 1 (a number) or 3 (red, green, blue) are read");
    const std::string none =
        "fog.vol: is not a volume file of Mitsuba: it does not begin with 'VOL' "
        "and a header of 48 bytes";
    for (const std::string& bytes : {std::string(), std::string("VOL\3"), std::string(100, 'x')}) {
        write("fog.vol", bytes);
        EXPECT_EQ(error_of([&] { volume(""); }), none);
    }
}

TEST(VolumeData, PublicFilesAreRead) {
    const std::filesystem::path file =
        std::filesystem::path(NACRE_SHARED_DIR) / "data/volume/smoke_mitsuba.vol";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    const auto g = read_vol(file);
    EXPECT_EQ(g->nx, 128);
    EXPECT_EQ(g->ny, 128);
    EXPECT_EQ(g->nz, 50);
    const Point3f centre = g->file_placement.point({0.5f, 0.5f, 0.5f});
    EXPECT_NEAR(length(centre), 0.f, 1e-6f);
}

}  // namespace
}  // namespace nacre
