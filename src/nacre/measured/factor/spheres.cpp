#include "nacre/measured/factor/spheres.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

struct DirectionalLight {
    Vec3d to_light;
    double irradiance;
};

const std::array<DirectionalLight, 3> lights = {{{normalize(Vec3d{-1., 1., 1.3}), 1.},
                                                 {normalize(Vec3d{1.4, 0.1, 0.9}), 0.5},
                                                 {normalize(Vec3d{0.3, 1., -0.6}), 0.35}}};
constexpr double radius = 0.47;       // of the square's side
constexpr double background = 0.045;  // between black and the shadows, so that outlines show
constexpr double white_share = 0.02;  // of lit pixels that may be brighter than white

/// Radiance of the point of the unit sphere that is seen at x, y.
Vec3d radiance(const Target& brdf, double x, double y) {
    const Vec3d n{x, y, std::sqrt(std::max(0., 1. - x * x - y * y))};
    const double across = std::hypot(n.x, n.z);
    const Vec3d t = across > 1e-9 ? Vec3d{n.z / across, 0., -n.x / across} : Vec3d{1., 0., 0.};
    const Vec3d b = cross(n, t);
    const auto local = [&](const Vec3d& w) { return Vec3d{dot(w, t), dot(w, b), dot(w, n)}; };
    const Vec3d wo = local({0., 0., 1.});
    Vec3d sum;
    for (const DirectionalLight& light : lights) {
        const Vec3d wi = local(light.to_light);
        if (!(wi.z > 0. && wo.z > 0.)) continue;
        if (const auto f = brdf.value(wi, wo)) sum += *f * (light.irradiance * wi.z);
    }
    return sum;
}

struct Sphere {
    std::vector<Vec3d> color;     ///< mean of the samples that meet the sphere
    std::vector<double> covered;  ///< share of them
};

Sphere draw_sphere(const Target& brdf, const SphereOptions& o) {
    const int size = o.size, side = o.samples;
    Sphere r;
    r.color.resize(std::size_t(size) * size);
    r.covered.resize(r.color.size());
    tbb::parallel_for(0, size, [&](int py) {
        for (int px = 0; px < size; ++px) {
            Vec3d sum;
            int met = 0;
            for (int s = 0; s < side * side; ++s) {
                const double x = ((px + (s % side + 0.5) / side) / size - 0.5) / radius;
                const double y = (0.5 - (py + (s / side + 0.5) / side) / size) / radius;
                if (x * x + y * y >= 1.) continue;
                sum += radiance(brdf, x, y);
                ++met;
            }
            const std::size_t at = std::size_t(py) * size + px;
            if (met) r.color[at] = sum / met;
            r.covered[at] = double(met) / (side * side);
        }
    });
    return r;
}

double brightest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

/// What multiplies radiance so that few pixels are brighter than white.
double exposure(const Sphere& s) {
    std::vector<double> lit;
    for (const Vec3d& v : s.color)
        if (brightest(v) > 0.) lit.push_back(brightest(v));
    if (lit.empty()) return 1.;
    const auto at = lit.begin() + std::ptrdiff_t((1. - white_share) * double(lit.size() - 1));
    std::nth_element(lit.begin(), at, lit.end());
    return 1. / *at;
}

void put(Image& image, const Sphere& s, double scale, int left, int top, int size) {
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const std::size_t at = std::size_t(y) * size + x;
            const double c = s.covered[at];
            for (int k = 0; k < 3; ++k)
                image.at(left + x, top + y, k) =
                    float(c * scale * s.color[at][k] + (1. - c) * background);
        }
}

}  // namespace

Image draw_spheres(std::span<const SphereGroup> groups, const SphereOptions& options) {
    const int size = options.size, gap = size / 8;
    int width = 0;
    for (const SphereGroup& g : groups)
        width += size * int(std::max<std::size_t>(g.approximations.size(), 1));
    width += gap * int(groups.size() - 1);
    Image image(width, 2 * size);
    std::fill(image.data.begin(), image.data.end(), float(background));
    int left = 0;
    for (const SphereGroup& g : groups) {
        const int count = int(g.approximations.size());
        const Sphere original = draw_sphere(*g.original, options);
        const double scale = exposure(original);
        put(image, original, scale, left + std::max(count - 1, 0) * size / 2, 0, size);
        for (int i = 0; i < count; ++i)
            put(image, draw_sphere(*g.approximations[i], options), scale, left + i * size, size,
                size);
        left += size * std::max(count, 1) + gap;
    }
    return image;
}

}  // namespace nacre
