#include "nacre/geometry/surface_nets.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "nacre/math/error.h"

namespace nacre {
namespace {

// Blocks of 4^3 corners: small enough that the band of blocks the surface touches is thin, large
// enough that finding them costs one evaluation in 64.
constexpr int kSide = 4, kCorners = kSide * kSide * kSide;
// Cells by which a block may be missed by the surface and still be evaluated: the repair of
// ambiguous cells may move the surface by a cell, and faces look one cell further.
constexpr float kMargin = 2.f;

struct Index3 {
    int x, y, z;
    friend Index3 operator+(Index3 a, Index3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
};
constexpr Index3 corner_offset(int c) { return {c & 1, (c >> 1) & 1, c >> 2}; }

struct Block {
    Index3 first;                              // lattice index of the first corner
    std::array<float, kCorners> value;         // field at the corners
    std::array<std::uint32_t, kCorners> slot;  // vertex of the cell above each corner
    std::vector<Point3f> positions;
    std::vector<Vec3f> normals;
    std::vector<Mesh::Triangle> triangles;
    std::uint32_t first_vertex = 0;
};

/// Field values on a lattice, kept only in blocks near the surface.
class Lattice {
  public:
    Lattice(const DistanceField& field, const SurfaceNetsOptions& o)
        : field_(field), origin_(o.box.lower), cell_(o.cell) {
        const Vec3f extent = o.box.diagonal();
        const auto blocks = [&](float length) { return int(std::ceil(length / (cell_ * kSide))); };
        size_ = {blocks(extent.x), blocks(extent.y), blocks(extent.z)};
        find_blocks(o.lipschitz);
        evaluate();
        repair();
    }

    Mesh mesh() {
        tbb::parallel_for(std::size_t(0), blocks_.size(),
                          [&](std::size_t b) { place(blocks_[b]); });
        std::uint32_t vertices = 0;
        std::size_t triangles = 0;
        for (Block& b : blocks_) {
            b.first_vertex = vertices;
            vertices += std::uint32_t(b.positions.size());
        }
        tbb::parallel_for(std::size_t(0), blocks_.size(), [&](std::size_t b) { join(blocks_[b]); });
        for (const Block& b : blocks_) triangles += b.triangles.size();

        Mesh mesh;
        mesh.positions.reserve(vertices);
        mesh.normals.reserve(vertices);
        mesh.triangles.reserve(triangles);
        for (const Block& b : blocks_) {
            mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
            mesh.normals.insert(mesh.normals.end(), b.normals.begin(), b.normals.end());
            mesh.triangles.insert(mesh.triangles.end(), b.triangles.begin(), b.triangles.end());
        }
        return mesh;
    }

  private:
    Point3f position(Index3 i) const {
        return origin_ + Vec3f(float(i.x), float(i.y), float(i.z)) * cell_;
    }
    static int local(Index3 i) {
        constexpr int mask = kSide - 1;
        return (i.x & mask) + kSide * ((i.y & mask) + kSide * (i.z & mask));
    }
    static Index3 local_index(int c) {
        return {c % kSide, (c / kSide) % kSide, c / (kSide * kSide)};
    }
    std::size_t block_index(Index3 i) const {
        return std::size_t(i.x / kSide) +
               std::size_t(size_.x) *
                   (std::size_t(i.y / kSide) + std::size_t(size_.y) * std::size_t(i.z / kSide));
    }
    bool on_side(Index3 i) const {
        return i.x == 0 || i.y == 0 || i.z == 0 || i.x == size_.x * kSide - 1 ||
               i.y == size_.y * kSide - 1 || i.z == size_.z * kSide - 1;
    }
    /// Field at a corner; where it was not evaluated, a value of its sign. Beyond the lattice: out.
    float value(Index3 i) const {
        if (i.x >= size_.x * kSide || i.y >= size_.y * kSide || i.z >= size_.z * kSide)
            return cell_;
        const int b = map_[block_index(i)];
        return b >= 0 ? blocks_[std::size_t(b)].value[std::size_t(local(i))]
                      : (b == kOutside ? cell_ : -cell_);
    }
    bool inside(Index3 i) const { return value(i) < 0.f; }

    void find_blocks(float lipschitz) {
        const std::size_t layer = std::size_t(size_.x) * std::size_t(size_.y);
        map_.resize(layer * std::size_t(size_.z));
        const float reach =
            lipschitz * cell_ * (0.5f * float(kSide - 1) + kMargin) * std::sqrt(3.f);
        tbb::parallel_for(0, size_.z, [&](int z) {
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x) {
                    const Index3 first{x * kSide, y * kSide, z * kSide};
                    const float half = 0.5f * float(kSide - 1) * cell_;
                    const float d = field_(position(first) + Vec3f(half, half, half));
                    map_[block_index(first)] =
                        std::abs(d) <= reach ? 0 : (d > 0.f ? kOutside : kInside);
                }
        });
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x) {
                    const Index3 first{x * kSide, y * kSide, z * kSide};
                    int& b = map_[block_index(first)];
                    const Index3 last = first + Index3{kSide - 1, kSide - 1, kSide - 1};
                    if (b == kInside && (on_side(first) || on_side(last))) reject(first);
                    if (b != 0) continue;
                    b = int(blocks_.size());
                    blocks_.emplace_back().first = first;
                }
    }

    void evaluate() {
        tbb::parallel_for(std::size_t(0), blocks_.size(), [&](std::size_t n) {
            Block& b = blocks_[n];
            for (int c = 0; c < kCorners; ++c)
                b.value[std::size_t(c)] = field_(position(b.first + local_index(c)));
        });
        for (const Block& b : blocks_)
            for (int c = 0; c < kCorners; ++c) {
                const Index3 i = b.first + local_index(c);
                if (b.value[std::size_t(c)] < 0.f && on_side(i)) reject(i);
            }
    }

    [[noreturn]] void reject(Index3 i) const {
        const Point3f p = position(i);
        throw InputError(fmt::format(
            "surface nets: the surface reaches the side of the box at ({:.4g}, {:.4g}, {:.4g}); "
            "give a larger box",
            p.x, p.y, p.z));
    }

    /// The corner of the cell to be turned inside so that the inside (and the outside) of the cell
    /// hangs together by edges, or -1 if it does already.
    int ambiguous_corner(Index3 cell) const {
        std::array<float, 8> v{};
        int in = 0;
        for (int c = 0; c < 8; ++c) {
            v[std::size_t(c)] = value(cell + corner_offset(c));
            in += v[std::size_t(c)] < 0.f ? 1 << c : 0;
        }
        if (in == 0 || in == 255) return -1;
        const auto nearer = [&](int a, int b) {
            return v[std::size_t(a)] <= v[std::size_t(b)] ? a : b;
        };
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) {  // a face with a chequered pattern
                const int o = side << axis, u = 1 << ((axis + 1) % 3), w = 1 << ((axis + 2) % 3);
                const bool a = in >> o & 1, b = in >> (o + u) & 1, c = in >> (o + w) & 1,
                           d = in >> (o + u + w) & 1;
                if (a == d && b == c && a != b)
                    return a ? nearer(o + u, o + w) : nearer(o, o + u + w);
            }
        for (int c = 0; c < 4; ++c) {  // two opposite corners against the other six
            const int pair = 1 << c | 1 << (7 - c);
            if (in == (255 & ~pair)) return nearer(c, 7 - c);
            if (in == pair) return c ^ 1;
        }
        return -1;
    }

    /// Turns corners inside until no cell is ambiguous. Ends because corners are only ever added;
    /// every sweep reads one state and writes the next, so that the order does not matter.
    void repair() {
        std::vector<std::vector<Index3>> turned(blocks_.size());
        for (bool again = true; again;) {
            again = false;
            tbb::parallel_for(std::size_t(0), blocks_.size(), [&](std::size_t n) {
                turned[n].clear();
                for (int c = 0; c < kCorners; ++c) {
                    const Index3 cell = blocks_[n].first + local_index(c);
                    const int corner = ambiguous_corner(cell);
                    if (corner >= 0) turned[n].push_back(cell + corner_offset(corner));
                }
            });
            for (const auto& list : turned)
                for (const Index3 i : list) {
                    blocks_[block_of(i)].value[std::size_t(local(i))] = -1e-4f * cell_;
                    again = true;
                }
        }
    }

    /// One vertex in every cell of the block that the surface crosses.
    void place(Block& b) const {
        for (int c = 0; c < kCorners; ++c) {
            const Index3 cell = b.first + local_index(c);
            std::array<float, 8> v{};
            int in = 0;
            for (int k = 0; k < 8; ++k) {
                v[std::size_t(k)] = value(cell + corner_offset(k));
                in += v[std::size_t(k)] < 0.f;
            }
            if (in == 0 || in == 8) continue;
            Vec3f sum;
            int crossings = 0;
            for (int k = 0; k < 8; ++k)
                for (int axis = 1; axis < 8; axis <<= 1) {
                    const float a = v[std::size_t(k)], e = v[std::size_t(k | axis)];
                    if ((k & axis) || (a < 0.f) == (e < 0.f)) continue;
                    const Point3f pa = position(cell + corner_offset(k));
                    sum += pa + (position(cell + corner_offset(k | axis)) - pa) * (a / (a - e));
                    ++crossings;
                }
            b.slot[std::size_t(c)] = std::uint32_t(b.positions.size());
            const Point3f p = project(sum / float(crossings));
            b.positions.push_back(p);
            b.normals.push_back(normal(p));
        }
    }

    /// Newton steps along the gradient; no further than a cell from where it began.
    Point3f project(const Point3f& start) const {
        Point3f p = start;
        for (int step = 0; step < 4; ++step) {
            const float d = field_(p);
            if (std::abs(d) < 1e-4f * cell_) break;
            const Vec3f g = gradient(field_, p, kStep * cell_);
            p += g * (-d / std::max(dot(g, g), 0.1f));
            const Vec3f moved = p - start;
            if (length(moved) > cell_) p = start + normalize(moved) * cell_;
        }
        return p;
    }

    /// Unit gradient; up where the field is flat, which no distance is.
    Vec3f normal(const Point3f& p) const {
        const Vec3f g = gradient(field_, p, kStep * cell_);
        const float l = length(g);
        return l > 1e-6f ? g / l : Vec3f(0, 1, 0);
    }

    std::size_t block_of(Index3 i) const {
        const int b = map_[block_index(i)];
        if (b < 0)
            throw InputError(
                "surface nets: the field changes faster than its Lipschitz bound says; raise it");
        return std::size_t(b);
    }
    std::uint32_t vertex(Index3 cell) const {
        const Block& b = blocks_[block_of(cell)];
        return b.first_vertex + b.slot[std::size_t(local(cell))];
    }
    const Point3f& vertex_position(Index3 cell) const {
        const Block& b = blocks_[block_of(cell)];
        return b.positions[b.slot[std::size_t(local(cell))]];
    }

    /// Two triangles round every crossed lattice edge that begins in the block.
    void join(Block& b) const {
        constexpr std::array<Index3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (int c = 0; c < kCorners; ++c) {
            const Index3 i = b.first + local_index(c);
            const bool in = b.value[std::size_t(c)] < 0.f;
            for (std::size_t a = 0; a < 3; ++a) {
                if (inside(i + axes[a]) == in) continue;
                const auto back = [&](bool u, bool w) {
                    const Index3 du = axes[(a + 1) % 3], dw = axes[(a + 2) % 3];
                    return Index3{i.x - u * du.x - w * dw.x, i.y - u * du.y - w * dw.y,
                                  i.z - u * du.z - w * dw.z};
                };
                // Counter-clockwise about the axis, hence seen from its positive end.
                std::array<Index3, 4> q{back(true, true), back(false, true), back(false, false),
                                        back(true, false)};
                if (!in) std::swap(q[1], q[3]);
                const std::array<std::uint32_t, 4> v{vertex(q[0]), vertex(q[1]), vertex(q[2]),
                                                     vertex(q[3])};
                const auto diagonal = [&](std::size_t k) {
                    return length_squared(vertex_position(q[k]) - vertex_position(q[k + 2]));
                };
                if (diagonal(0) <= diagonal(1)) {
                    b.triangles.push_back({v[0], v[1], v[2]});
                    b.triangles.push_back({v[0], v[2], v[3]});
                } else {
                    b.triangles.push_back({v[1], v[2], v[3]});
                    b.triangles.push_back({v[1], v[3], v[0]});
                }
            }
        }
    }

    static constexpr int kOutside = -1, kInside = -2;
    static constexpr float kStep = 0.1f;  // of a cell: below any feature, far above round-off

    const DistanceField& field_;
    Point3f origin_;
    float cell_;
    Index3 size_{};         // in blocks
    std::vector<int> map_;  // block number, or kOutside, kInside
    std::vector<Block> blocks_;
};

}  // namespace

Vec3f gradient(const DistanceField& field, const Point3f& p, float step) {
    constexpr std::array<std::array<float, 3>, 4> corners{
        {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
    Vec3f sum;
    for (const auto& c : corners) {
        const Vec3f k{c[0], c[1], c[2]};
        sum += k * field(p + k * step);
    }
    return sum / (4.f * step);
}

Mesh surface_nets(const DistanceField& field, const SurfaceNetsOptions& options) {
    if (!(options.cell > 0.f) || options.box.empty() || !(options.lipschitz > 0.f))
        throw InputError(
            "surface nets: the cell, the box and the Lipschitz bound must be positive");
    return Lattice(field, options).mesh();
}

}  // namespace nacre
