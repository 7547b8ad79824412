#pragma once
// Microgeometry that is generated: one period of it as triangles, by name and parameters.
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "nacre/catalogue/catalogue.h"
#include "nacre/catalogue/settings.h"
#include "nacre/geometry/mesh.h"

namespace nacre {

/// A mesh whose tile [0, width) x [0, height) repeats; it reaches beyond the tile on all sides, as
/// `Patch` wants it. Its mean normal is +z. Triangles have no normals but their own.
struct Microgeometry {
    Mesh mesh;
    double width = 1., height = 1.;
};

/// What a kind of microgeometry says of itself.
struct MicrogeometryDescription {
    std::string_view name;
    std::string_view title;
    std::string_view meaning;
    std::vector<Parameter> parameters;
    std::vector<std::string_view> references = {};
    Microgeometry (*make)(const ParameterValues& values) = nullptr;
    /// Instead, for what is read from a file: its parameter file=NAME comes beside the others.
    Microgeometry (*make_of_file)(const ParameterValues& values,
                                  const std::filesystem::path& file) = nullptr;
};

/// The list. Angles in it are in degrees, lengths in the unit that each names.
const Catalogue<MicrogeometryDescription>& microgeometries();

/// "v_grooves angle=30": one of the list by its name, with its parameters. Throws InputError for
/// names and values that mean nothing, for combinations that have no surface, and for files that
/// cannot be read.
Microgeometry make_microgeometry(std::string_view text);

// The descriptions, one a file.
extern const MicrogeometryDescription flat_geometry, cylinder_geometry, v_groove_geometry,
    gaussian_geometry, fractal_geometry, brushed_geometry, picture_geometry, fibre_geometry,
    weave_geometry;

/// Heights over a grid of `columns` x `rows` points with spacing `step`, row after row; the grid
/// repeats. One cell more stands on each side of the tile.
Microgeometry height_field(int columns, int rows, double step, const std::vector<double>& heights);

/// The profile (y, z), from y = 0 to the first point a period on, pulled along x; it repeats.
/// Points in increasing y, the first of them at 0 and none at `period`.
Microgeometry extruded_profile(const std::vector<Vec2<double>>& profile, double period);

}  // namespace nacre
