#include "nacre/diffusion/cell_grid.h"

#include <tbb/parallel_for.h>

namespace nacre {
namespace {

// A cell with less of the inside than this, and no face through which light could come, is none.
constexpr double least_volume = 1e-12;

bool holds_something(const CutCell& c) {
    if (!(c.volume > least_volume)) return false;
    return std::any_of(c.aperture.begin(), c.aperture.end(), [](double a) { return a > 0.; });
}

}  // namespace

CellGrid::CellGrid(const Mesh& mesh, const GridFrame& frame) : frame_(frame) {
    {
        CutSurface surface = cut_cells(mesh, frame);
        overlaps_ = surface.overlaps;
        std::erase_if(surface.cells, [](const CutCell& c) { return !holds_something(c); });
        number_cells(surface);
        cuts_ = std::move(surface.cells);
    }
    connect();
    count_thin();
}

// Within a colour cells are in order of their places, so that neighbours are near in memory.
void CellGrid::number_cells(const CutSurface& surface) {
    const auto place_of = [&](std::size_t number) {
        const std::size_t row = number / std::size_t(frame_.n[0]);
        return CellPlace{std::int32_t(number % std::size_t(frame_.n[0])),
                         std::int32_t(row % std::size_t(frame_.n[1])),
                         std::int32_t(row / std::size_t(frame_.n[1]))};
    };
    const auto odd = [](const CellPlace& p) { return (p[0] + p[1] + p[2]) & 1; };
    at_.assign(frame_.count(), none);
    cell_of_cut_.resize(surface.cells.size());
    for (const int colour : {0, 1}) {
        auto run = surface.inside.begin();
        const auto whole_until = [&](std::size_t end) {
            for (; run != surface.inside.end() && (*run)[0] < end; ++run)
                for (std::size_t number = (*run)[0]; number < (*run)[1]; ++number) {
                    const CellPlace p = place_of(number);
                    if (odd(p) != colour) continue;
                    at_[number] = std::uint32_t(place_.size());
                    place_.push_back(p);
                    cut_of_.push_back(-1);
                }
        };
        for (std::size_t c = 0; c < surface.cells.size(); ++c) {
            const CellPlace& p = surface.cells[c].at;
            const std::size_t number = frame_.number(p);
            whole_until(number);
            if (odd(p) != colour) continue;
            at_[number] = cell_of_cut_[c] = std::uint32_t(place_.size());
            place_.push_back(p);
            cut_of_.push_back(std::int32_t(c));
        }
        whole_until(frame_.count());
        if (colour == 0) even_ = place_.size();
    }
}

void CellGrid::connect() {
    neighbour_.resize(size());
    tbb::parallel_for(std::size_t(0), size(), [&](std::size_t cell) {
        for (std::size_t face = 0; face < 6; ++face) {
            CellPlace p = place_[cell];
            p[face / 2] += face % 2 ? 1 : -1;
            neighbour_[cell][face] = aperture(cell, face) > 0. ? at(p) : none;
        }
    });
}

void CellGrid::count_thin() {
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
        const CellPlace& p = cuts_[c].at;
        bool whole_beside = false;
        for (int n = 0; n < 125 && !whole_beside; ++n) {
            const std::uint32_t other =
                at({p[0] + n % 5 - 2, p[1] + n / 5 % 5 - 2, p[2] + n / 25 - 2});
            whole_beside = other != none && cut_of_[other] < 0;
        }
        if (whole_beside) continue;
        ++thin_cells_;
        thin_area_ += cuts_[c].area;
    }
}

std::uint32_t CellGrid::at(const CellPlace& p) const {
    for (std::size_t a = 0; a < 3; ++a)
        if (p[a] < 0 || p[a] >= frame_.n[a]) return none;
    return at_[frame_.number(p)];
}

double CellGrid::volume() const {
    double whole = double(size() - cuts_.size()), cut = 0.;
    for (const CutCell& c : cuts_) cut += c.volume;
    return (whole + cut) * frame_.h * frame_.h * frame_.h;
}

double CellGrid::area() const {
    double sum = 0.;
    for (const CutCell& c : cuts_) sum += c.area;
    return sum;
}

std::size_t CellGrid::bytes() const {
    return place_.capacity() * sizeof(CellPlace) + neighbour_.capacity() * sizeof(neighbour_[0]) +
           cut_of_.capacity() * 4 + cuts_.capacity() * sizeof(CutCell) +
           cell_of_cut_.capacity() * 4 + at_.capacity() * 4;
}

}  // namespace nacre
