#include "nacre/reflectance/rough_boundary.h"

#include "nacre/math/quadrature.h"
#include "nacre/optics/fresnel.h"

namespace nacre {

template <class Distribution>
double rough_reflectance(const Distribution& distribution, const Vec3d& w, double eta,
                         std::size_t n) {
    const GaussLegendre nodes(n);
    double sum = 0.;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const Vec2<double> u{0.5 + 0.5 * nodes.node[i], 0.5 + 0.5 * nodes.node[j]};
            const Vec3d h = distribution.sample_visible(w, u);
            const Vec3d out = reflect(w, h);
            if (!(out.z > 0.)) continue;
            sum += 0.25 * nodes.weight[i] * nodes.weight[j] *
                   fresnel_dielectric(std::max(dot(w, h), 0.), eta) *
                   smith_g1(distribution, out, h);
        }
    return sum;
}

template <class Distribution>
RoughBoundary::RoughBoundary(const Distribution& distribution, double eta) {
    // Leaving the denser side, F has a kink at the critical angle, which wants more nodes.
    constexpr std::size_t smooth = 32, kinked = 96;
    double sum = 0.;
    for (int i = 0; i < size; ++i) {
        const double mu = std::max(1e-6, double(i) / (size - 1));
        const Vec3d w{std::sqrt(1. - mu * mu), 0., mu};
        transmittance[i] = static_cast<float>(
            1. - rough_reflectance(distribution, w, eta, eta > 1. ? smooth : kinked));
        sum += mu * rough_reflectance(distribution, w, 1. / eta, eta > 1. ? kinked : smooth);
    }
    internal = static_cast<float>(2. * sum / size);
}

template RoughBoundary::RoughBoundary(const Beckmann<double>&, double);
template RoughBoundary::RoughBoundary(const Ggx<double>&, double);
template double rough_reflectance(const Beckmann<double>&, const Vec3d&, double, std::size_t);
template double rough_reflectance(const Ggx<double>&, const Vec3d&, double, std::size_t);

}  // namespace nacre
