#include "nacre/subsurface/diffusion_matter.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"

namespace nacre {
namespace {

constexpr int samples_a_side = 24;

struct Coefficients {
    Spectral sigma_t_prime, sigma_a;
};

Coefficients reduced_at(const Medium& medium, const Point3f& p, const Bands& bands, int g) {
    const MediumCoefficients c = medium.coefficients(p, bands.group(g));
    Coefficients r;
    r.sigma_a = max(Spectral(0.f), c.sigma_t - c.sigma_s);
    r.sigma_t_prime = c.sigma_s * Spectral(1.f - medium.phase.mean_cosine()) + r.sigma_a;
    const int used = std::min(4, bands.count() - 4 * g);
    for (int i = used; i < 4; ++i) {
        r.sigma_a.set(i, r.sigma_a[used - 1]);
        r.sigma_t_prime.set(i, r.sigma_t_prime[used - 1]);
    }
    return r;
}

}  // namespace

ReducedExtinction reduced_extinction(const Medium& medium, const Bands& bands, const Box3f& box) {
    ReducedExtinction r{1e30, 0.};
    const int n = medium.homogeneous() ? 1 : samples_a_side;
    const Vec3f size = box.diagonal();
    const auto at = [&](int i) { return (float(i) + 0.5f) / float(n); };
    for (int g = 0; g < bands.groups(); ++g)
        for (int z = 0; z < n; ++z)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const Point3f p =
                        box.lower + Vec3f(at(x) * size.x, at(y) * size.y, at(z) * size.z);
                    const Spectral s = reduced_at(medium, p, bands, g).sigma_t_prime;
                    r.least = std::min(r.least, double(min_lane(s)));
                    r.most = std::max(r.most, double(max_lane(s)));
                }
    return r;
}

DiffusionMatter diffusion_matter(const CellGrid& grid, const Medium& medium, const Bands& bands,
                                 int g, double boundary) {
    DiffusionMatter m;
    m.boundary = boundary;
    const GridFrame& f = grid.frame();
    const float least = float(1. / (f.h * double(*std::max_element(f.n.begin(), f.n.end()))));
    const std::size_t n =
        medium.homogeneous() ? std::min<std::size_t>(1, grid.size()) : grid.size();
    m.diffusion.resize(n);
    m.absorption.resize(n);
    for_blocks(0, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const Coefficients at = reduced_at(medium, Point3f(grid.center(c)), bands, g);
            if (!(min_lane(at.sigma_t_prime) >= 0.f)) {
                const Vec3d p = grid.center(c);
                throw InputError(
                    fmt::format("the medium's extinction is {:g} at ({:g}, {:g}, {:g}): densities "
                                "must not be negative",
                                min_lane(at.sigma_t_prime), p.x, p.y, p.z));
            }
            m.diffusion[c] = Spectral(1.f / 3.f) / max(at.sigma_t_prime, Spectral(least));
            m.absorption[c] = at.sigma_a;
        }
    });
    return m;
}

}  // namespace nacre
