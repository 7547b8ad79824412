// OpenVDB grids, written here and read back.
#include <openvdb/openvdb.h>

#include "nacre/math/random.h"
#include "nacre/scene/media/volume_grid.h"
#include "tests/scene/bands.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

class OpenVdb : public SceneFiles {
  protected:
    void SetUp() override {
        SceneFiles::SetUp();
        openvdb::initialize();
    }
    /// Density i + 2 j + 4 k over a box of 10 x 6 x 4 voxels from (-2, 3, 5), voxels of size 0.5.
    std::filesystem::path write_density() {
        const auto density = openvdb::FloatGrid::create(0.f);
        density->setName("density");
        density->setGridClass(openvdb::GRID_FOG_VOLUME);
        density->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
        auto accessor = density->getAccessor();
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 6; ++j)
                for (int i = 0; i < 10; ++i)
                    accessor.setValue({i - 2, j + 3, k + 5}, float(i + 2 * j + 4 * k));
        const auto other = openvdb::Vec3SGrid::create();
        other->setName("velocity");
        return save({other, density});
    }
    std::filesystem::path save(const openvdb::GridPtrVec& grids) {
        const auto path = folder_ / "fog.vdb";
        openvdb::io::File file(path.string());
        file.write(grids);
        file.close();
        return path;
    }
};

TEST_F(OpenVdb, DenseAndSparseGridsAgreeWithWhatWasWritten) {
    const auto file = write_density();
    Random random(1);
    for (const std::size_t limit : {largest_dense_vdb, std::size_t(0)}) {
        const VolumePtr unit = make_vdb_volume(file, "", false, {}, limit);
        const VolumePtr placed = make_vdb_volume(file, "density", true, {}, limit);
        EXPECT_EQ(unit->max(), 9.f + 10.f + 12.f);
        // Index i is a voxel's centre: the box begins half a voxel before -2, at -1.25 in the
        // world.
        EXPECT_NEAR(placed->bounds().lower.x, -1.25f, 1e-6f);
        EXPECT_NEAR(placed->bounds().upper.z, 4.25f, 1e-6f);
        for (int n = 0; n < 300; ++n) {
            // Linear between the outermost centres.
            const float i = 9.f * random.next(), j = 5.f * random.next(), k = 3.f * random.next();
            const float expected = i + 2.f * j + 4.f * k;
            EXPECT_NEAR(unit->eval({(i + 0.5f) / 10, (j + 0.5f) / 6, (k + 0.5f) / 4}, bands)[1],
                        expected, 1e-4f);
            EXPECT_NEAR(placed->eval({0.5f * (i - 2), 0.5f * (j + 3), 0.5f * (k + 5)}, bands)[1],
                        expected, 1e-4f);
        }
        // Clamped in the outer half of the first voxel, nothing outside.
        EXPECT_NEAR(unit->eval({0.f, 0.f, 0.f}, bands)[0], 0.f, 1e-6f);
        EXPECT_NEAR(unit->eval({1.f, 1.f, 1.f}, bands)[0], 31.f, 1e-4f);
        EXPECT_EQ(unit->eval({1.01f, 0.5f, 0.5f}, bands)[0], 0.f);
    }
}

TEST_F(OpenVdb, WrongFilesAreExplained) {
    const auto file = write_density();
    EXPECT_EQ(error_of([&] { make_vdb_volume(file, "densty", false, {}); }),
              "fog.vdb: has no grid 'densty'; did you mean 'density'?");
    EXPECT_EQ(error_of([&] { make_vdb_volume(file, "velocity", false, {}); }),
              "fog.vdb: the grid 'velocity' does not hold floats");
    GridVolumeOptions albedo;
    albedo.role = ColorRole::reflectance;
    EXPECT_EQ(error_of([&] { make_vdb_volume(file, "", false, albedo); }),
              "fog.vdb: voxel (2, 0, 0) has the value 2; an albedo must lie within [0, 1]");

    const auto distance = openvdb::FloatGrid::create(1.5f);
    distance->setGridClass(openvdb::GRID_LEVEL_SET);
    distance->tree().setValue({0, 0, 0}, -1.f);
    distance->setName("ball");
    save({distance});
    EXPECT_EQ(error_of([&] { make_vdb_volume(folder_ / "fog.vdb", "", false, {}); }),
              "fog.vdb: the grid 'ball' is a level set, which holds distances; a medium needs a "
              "density (a fog volume)");

    write("bad.vdb", "not a volume");
    const std::string error =
        error_of([&] { make_vdb_volume(folder_ / "bad.vdb", "", false, {}); });
    EXPECT_TRUE(error.starts_with("bad.vdb: cannot be read as OpenVDB (")) << error;
}

}  // namespace
}  // namespace nacre
