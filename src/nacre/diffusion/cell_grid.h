#pragma once
// The cells of a uniform grid that hold some of the inside of a mesh, numbered without gaps, with
// what connects them and what of the surface they hold. Cells of even i + j + k come first: no two
// of them are neighbours, nor two of the others, so each half can be relaxed at once.
#include <span>

#include "nacre/diffusion/cut_cells.h"

namespace nacre {

class CellGrid {
  public:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// Throws as `cut_cells`.
    CellGrid(const Mesh& mesh, const GridFrame& frame);

    const GridFrame& frame() const { return frame_; }
    std::size_t size() const { return place_.size(); }
    /// The number of cells of the first colour.
    std::size_t even() const { return even_; }
    const CellPlace& place(std::size_t cell) const { return place_[cell]; }
    Vec3d center(std::size_t cell) const { return frame_.center(place_[cell]); }
    /// Share of the cell that is inside.
    double volume(std::size_t cell) const {
        const CutCell* c = cut(cell);
        return c ? c->volume : 1.;
    }
    /// The cell beyond face 0..5 (lower and upper in x, then y, then z), or `none`; and the share
    /// of that face which is inside.
    std::uint32_t neighbour(std::size_t cell, std::size_t face) const {
        return neighbour_[cell][face];
    }
    double aperture(std::size_t cell, std::size_t face) const {
        const CutCell* c = cut(cell);
        return c ? c->aperture[face] : 1.;
    }
    /// What the surface is in this cell; null if it does not pass through.
    const CutCell* cut(std::size_t cell) const {
        return cut_of_[cell] < 0 ? nullptr : &cuts_[std::size_t(cut_of_[cell])];
    }
    /// Where the normal of a cut from its cell's centre meets the surface: what is given on the
    /// surface, such as q, should be taken from there, because the boundary's one point is the
    /// centre. From the surface's centroid it is of order 1.65 instead of 2.
    Vec3d foot(const CutCell& cut) const {
        const double a = length(cut.area_vector);
        return a > 0. ? frame_.center(cut.at) + cut.area_vector * (cut.offset / a) : cut.centroid;
    }
    /// Place of the cell's surface in `cuts`, -1 if it has none.
    std::int32_t cut_number(std::size_t cell) const { return cut_of_[cell]; }
    std::span<const CutCell> cuts() const { return cuts_; }
    /// The cell of an entry of `cuts`.
    std::uint32_t cell_of_cut(std::size_t cut) const { return cell_of_cut_[cut]; }
    /// The cell at a place, or `none`; the place may be outside of the grid.
    std::uint32_t at(const CellPlace& place) const;

    /// Cut cells without a whole one within two cells: parts of the object that are thinner than two
    /// to three cells, where no value inside backs what the boundary's one point says.
    std::size_t thin_cells() const { return thin_cells_; }
    double thin_area() const { return thin_area_; }  ///< of the surface in those
    double volume() const;                           ///< of the inside
    double area() const;                             ///< of the surface
    /// Faces that the mesh covers twice or from the wrong side: it overlaps itself there.
    std::size_t overlaps() const { return overlaps_; }
    std::size_t bytes() const;

  private:
    void number_cells(const CutSurface& surface);
    void connect();
    void count_thin();

    GridFrame frame_;
    std::size_t even_ = 0;
    std::vector<CellPlace> place_;
    std::vector<std::array<std::uint32_t, 6>> neighbour_;
    std::vector<std::int32_t> cut_of_;
    std::vector<CutCell> cuts_;
    std::vector<std::uint32_t> cell_of_cut_;
    std::vector<std::uint32_t> at_;  ///< cells by their number in the frame
    std::size_t thin_cells_ = 0, overlaps_ = 0;
    double thin_area_ = 0.;
};

}  // namespace nacre
