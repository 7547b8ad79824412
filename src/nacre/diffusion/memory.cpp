#include "nacre/diffusion/memory.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/math/error.h"

namespace nacre {
namespace {

// Measured on the bunny: 2.1 GB for 3.5 million cells at the worst, the place in the frame apart.
constexpr double bytes_a_cell = 620., bytes_a_place = 8., bytes_a_cut = 500.;
// Cells that a surface passes through, per area of a cell's face.
constexpr double cuts_a_face = 1.5;

}  // namespace

DiffusionMemory diffusion_memory(const Mesh& mesh, const GridFrame& frame) {
    double volume = 0., area = 0.;
    for (const Mesh::Triangle& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
        const Vec3d vector = cross(b - a, c - a) * 0.5;
        area += length(vector);
        volume += dot(a - frame.origin, vector) / 3.;
    }
    const double h = frame.h, cuts = cuts_a_face * area / (h * h);
    DiffusionMemory m;
    m.cells = std::abs(volume) / (h * h * h) + 0.5 * cuts;
    const double places = double(frame.n[0]) * double(frame.n[1]) * double(frame.n[2]);
    m.bytes = bytes_a_cell * m.cells + bytes_a_cut * cuts + bytes_a_place * places;
    return m;
}

void check_memory(const Mesh& mesh, double cells, double limit, std::string_view option) {
    const auto needed = [&](double n) {
        return diffusion_memory(mesh, GridFrame::around(mesh.bounds(), n));
    };
    const DiffusionMemory all = needed(cells);
    // Numbers of cells are 32 bits long, and so are the numbers of their six links.
    constexpr double most_cells = 4.2e9 / 6.;
    if (all.bytes <= limit && all.cells <= most_cells) return;
    double low = 1., high = cells;
    for (int i = 0; i < 40; ++i) {
        const double middle = std::sqrt(low * high);
        const DiffusionMemory m = needed(middle);
        (m.bytes <= limit && m.cells <= most_cells ? low : high) = middle;
    }
    throw InputError(
        fmt::format("{} = {:g} takes a grid of {:.3g} cells and {:.3g} GB, and there are {:.3g} "
                    "GB: set {} to {} "
                    "or less",
                    option, cells, all.cells, all.bytes * 1e-9, limit * 1e-9, option,
                    std::int64_t(std::floor(low))));
}

}  // namespace nacre
