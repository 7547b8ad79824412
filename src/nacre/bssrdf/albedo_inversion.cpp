#include "nacre/bssrdf/albedo_inversion.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/math/error.h"

namespace nacre {

namespace {

// The medium of sigma_t' = 1 and reduced albedo 1 - y^2. Totals are nearly linear in y = sqrt(1 -
// alpha'), and near alpha' = 1, where all bright colours lie, y keeps the digits that alpha' loses.
ProfileMedium unit_medium(double y, double eta) {
    return ProfileMedium::reduced(1. - y * y, y * y, eta);
}

}  // namespace

ProfileMedium invert_albedo(std::string_view profile, double albedo, double free_path,
                            FreePath kind, double eta, const Settings& options) {
    if (!(albedo >= 0. && albedo < 1.))
        throw InputError(
            fmt::format("diffuse albedo = {:g} must be at least 0 and below 1", albedo));
    if (!(free_path > 0.) || !std::isfinite(free_path))
        throw InputError(
            fmt::format("mean free path = {:g} mm must be positive and finite", free_path));

    const auto made = [&](double y) { return make_profile(profile, unit_medium(y, eta), options); };
    const auto brightest = made(0.);
    if (!brightest->description().invertible)
        throw InputError(
            fmt::format("{}: its albedo does not follow from a medium, so that no medium follows "
                        "from an albedo",
                        brightest->description().name));
    if (albedo > brightest->total())
        throw InputError(fmt::format(
            "diffuse albedo = {:g} is beyond what {} reaches without absorption, {:.4g}", albedo,
            brightest->description().name, brightest->total()));

    // The total falls from y = 0 to 0 at y = 1: bisection, sped up by the secant where it halves
    // the bracket faster (Illinois form of regula falsi).
    double low = 0., high = 1.;
    double above = brightest->total() - albedo, below = -albedo;
    int side = 0;
    for (int i = 0; i < 100 && high - low > 1e-14 && albedo > 0.; ++i) {
        const double secant = low + (high - low) * above / (above - below);
        const double y = i % 4 == 3 ? 0.5 * (low + high) : secant;
        const double rest = made(y)->total() - albedo;
        if (std::abs(rest) < 1e-12) {
            low = high = y;
        } else if (rest > 0.) {
            low = y, above = rest;
            if (side == 1) below *= 0.5;
            side = 1;
        } else {
            high = y, below = rest;
            if (side == -1) above *= 0.5;
            side = -1;
        }
    }
    const double y = albedo > 0. ? 0.5 * (low + high) : 1.;
    const ProfileMedium unit = unit_medium(y, eta);
    const double transport =
        kind == FreePath::transport ? free_path : free_path * made(y)->sigma_tr();
    return ProfileMedium::reduced(unit.sigma_s / transport, unit.sigma_a / transport, eta);
}

}  // namespace nacre
