// OpenVDB files. The only file that knows the library: its headers are heavy.
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>

#include "nacre/math/error.h"
#include "nacre/scene/media/volume_grid.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

/// A grid in OpenVDB's own tree. Looked up from the root at every voxel, because OpenVDB's cached
/// accessors belong to one thread each.
class SparseVolume final : public Volume {
  public:
    SparseVolume(openvdb::FloatGrid::ConstPtr grid, const openvdb::CoordBBox& box,
                 const GridVolumeOptions& options, float largest)
        : grid_(std::move(grid)),
          first_(box.min().asVec3d() - openvdb::Vec3d(0.5)),
          size_(box.dim().asVec3d()),
          to_local_(options.to_world.inverse()),
          nearest_(options.filter == VolumeFilter::nearest),
          everywhere_(options.role == ColorRole::reflectance),
          max_(largest) {
        for (int corner = 0; corner < 8; ++corner)
            bounds_.extend(options.to_world.point(
                {float(corner & 1), float((corner >> 1) & 1), float(corner >> 2)}));
    }

    Spectral eval(const Point3f& p, const Wavelengths& w) const override {
        Vec3f q = to_local_.point(p);
        for (int i = 0; i < 3; ++i) {
            if (q[i] >= 0.f && q[i] <= 1.f) continue;
            if (!everywhere_) return Spectral(0.f);
            q[i] = std::clamp(q[i], 0.f, 1.f);
        }
        // Half a voxel from the edge the value stays that of the outermost voxel, as in a dense
        // grid with clamped coordinates.
        openvdb::Vec3d index;
        for (int i = 0; i < 3; ++i)
            index[i] = std::clamp(first_[i] + q[i] * size_[i], first_[i] + 0.5,
                                  first_[i] + size_[i] - 0.5);
        const float v = nearest_ ? openvdb::tools::PointSampler::sample(grid_->tree(), index)
                                 : openvdb::tools::BoxSampler::sample(grid_->tree(), index);
        return w.mode == ColorMode::rgb_bands ? Spectral(v, v, v, 0.f) : Spectral(v);
    }
    float max() const override { return max_; }
    Box3f bounds() const override { return bounds_; }

  private:
    openvdb::FloatGrid::ConstPtr grid_;
    openvdb::Vec3d first_, size_;  ///< of the box in index space
    Transform to_local_;
    bool nearest_, everywhere_;
    float max_;
    Box3f bounds_;
};

openvdb::FloatGrid::Ptr read_grid(const std::filesystem::path& file, const std::string& wanted) {
    const auto fail = [&](const std::string& what) {
        throw InputError(fmt::format("{}: {}", file.string(), what));
    };
    openvdb::initialize();
    openvdb::FloatGrid::Ptr grid;
    try {
        openvdb::io::File in(file.string());
        in.open();
        std::vector<std::string> names;
        for (auto name = in.beginName(); name != in.endName(); ++name) {
            names.push_back(name.gridName());
            if (!wanted.empty() && names.back() != wanted) continue;
            if (in.readGridMetadata(*name)->isType<openvdb::FloatGrid>()) {
                grid = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid(*name));
                break;
            }
            if (!wanted.empty()) fail(fmt::format("the grid '{}' does not hold floats", wanted));
        }
        if (!grid && !wanted.empty())
            fail(fmt::format("has no grid '{}'{}", wanted, suggestion(wanted, names)));
    } catch (const openvdb::Exception& error) {
        fail(fmt::format("cannot be read as OpenVDB ({})", error.what()));
    }
    if (!grid) fail("has no grid of floats");
    if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
        fail(
            fmt::format("the grid '{}' is a level set, which holds distances; a medium needs a "
                        "density (a fog volume)",
                        grid->getName()));
    if (!grid->transform().isLinear())
        fail(fmt::format("the grid '{}' has a transform that is not affine", grid->getName()));
    return grid;
}

/// From the unit cube over `box` to the file's world space; voxel (i, j, k) is centred at its
/// index.
Transform placement(const openvdb::FloatGrid& grid, const openvdb::CoordBBox& box) {
    const openvdb::Mat4R m = grid.transform().baseMap()->getAffineMap()->getMat4();
    Transform::Matrix index_to_world;
    for (int row = 0; row < 4; ++row)  // OpenVDB multiplies row vectors from the left
        for (int column = 0; column < 4; ++column)
            index_to_world[4 * row + column] = m(column, row);
    const openvdb::Vec3d low = box.min().asVec3d(), size = box.dim().asVec3d();
    return Transform(index_to_world) *
           Transform::translate({low.x() - 0.5, low.y() - 0.5, low.z() - 0.5}) *
           Transform::scale({size.x(), size.y(), size.z()});
}

}  // namespace

VolumePtr make_vdb_volume(const std::filesystem::path& file, const std::string& name,
                          bool use_grid_bbox, GridVolumeOptions options,
                          std::size_t largest_dense) {
    const openvdb::FloatGrid::Ptr grid = read_grid(file, name);
    const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    if (box.empty())
        throw InputError(
            fmt::format("{}: the grid '{}' has no active voxel", file.string(), grid->getName()));
    if (use_grid_bbox) options.to_world = options.to_world * placement(*grid, box);

    const openvdb::Coord n = box.dim();
    if (static_cast<double>(n.x()) * n.y() * n.z() <= static_cast<double>(largest_dense)) {
        auto dense = std::make_shared<VoxelGrid>();
        dense->nx = n.x();
        dense->ny = n.y();
        dense->nz = n.z();
        dense->data.resize(std::size_t(n.x()) * n.y() * n.z());
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> view(box, dense->data.data());
        openvdb::tools::copyToDense(*grid, view);
        return make_grid_volume(dense, options, file.string());
    }

    const bool albedo = options.role == ColorRole::reflectance;
    float largest = std::max(0.f, grid->background());
    for (auto value = grid->cbeginValueAll(); value; ++value) {
        const float v = *value;
        if (!(v >= 0.f) || !std::isfinite(v) || (albedo && v > 1.f)) {
            const openvdb::Coord at = value.getCoord();
            throw InputError(fmt::format("{}: voxel ({}, {}, {}) of the grid has the value {}; {}",
                                         file.string(), at.x(), at.y(), at.z(), v,
                                         albedo ? "an albedo must lie within [0, 1]"
                                                : "a coefficient must be finite and at least 0"));
        }
        largest = std::max(largest, v);
    }
    if (options.wrap != VolumeWrap::clamp)
        throw InputError(
            fmt::format("{}: the grid is too large to be made dense, and sparse grids "
                        "have no wrap_mode but clamp",
                        file.string()));
    return std::make_shared<SparseVolume>(grid, box, options, largest);
}

}  // namespace nacre
