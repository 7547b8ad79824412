#pragma once
// Volumes of voxels: in memory, from Mitsuba's .vol files and from OpenVDB's .vdb files.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "nacre/scene/build.h"

namespace nacre {

/// Voxels with x fastest, then y, then z; the channels of a voxel side by side.
struct VoxelGrid {
    int nx = 0, ny = 0, nz = 0;
    int channels = 1;  ///< 1, or 3 for linear RGB
    std::vector<float> data;
    /// From the unit cube that the voxels fill to where the file says that they are
    /// (`use_grid_bbox`); identity if it does not say.
    Transform file_placement;
};

enum class VolumeFilter { trilinear, nearest };
enum class VolumeWrap { clamp, repeat, mirror };

struct GridVolumeOptions {
    Transform to_world;  ///< from the unit cube, which the voxels fill, to the world
    VolumeFilter filter = VolumeFilter::trilinear;
    VolumeWrap wrap = VolumeWrap::clamp;
    /// reflectance: an albedo within [0, 1], defined everywhere; else a coefficient of at least 0
    /// that ends at the grid's bounds.
    ColorRole role = ColorRole::unbounded;
};

/// A volume over shared voxels. Values belong to the centres of voxels and are interpolated between
/// them, as in Mitsuba 3. Throws InputError for values outside the role's range, naming the voxel;
/// `name` stands for the grid in messages.
VolumePtr make_grid_volume(std::shared_ptr<const VoxelGrid> grid, const GridVolumeOptions& options,
                           const std::string& name);

/// Reads Mitsuba's .vol (version 3, float32, 1 or 3 channels). Throws InputError "FILE: ...".
std::shared_ptr<const VoxelGrid> read_vol(const std::filesystem::path& file);

/// Grids whose active box holds at most this many voxels (512 MiB) become dense; larger ones are
/// sampled in OpenVDB's own tree, several times slower and with the whole grid's maximum as the
/// only bound.
inline constexpr std::size_t largest_dense_vdb = std::size_t(1) << 27;

/// The float grid called `grid` (or the first one, if empty) of an OpenVDB file. The box of its
/// active voxels is what `to_world` maps from the unit cube; with `use_grid_bbox` the file's own
/// transform is applied before. Throws InputError "FILE: ...", also for level sets, which are
/// distances and not densities.
VolumePtr make_vdb_volume(const std::filesystem::path& file, const std::string& grid,
                          bool use_grid_bbox, GridVolumeOptions options,
                          std::size_t largest_dense = largest_dense_vdb);

}  // namespace nacre
