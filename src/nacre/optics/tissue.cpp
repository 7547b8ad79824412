#include "nacre/optics/tissue.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "nacre/math/error.h"
#include "nacre/optics/haemoglobin.h"

namespace nacre {

namespace {

constexpr double per_cm = 0.1;  // in mm^-1

void require_wavelength(double nm) {
    if (!(nm >= haemoglobin_first && nm <= haemoglobin_last))
        throw InputError(fmt::format("the optics of tissue are known from {} to {} nm; got {:g} nm",
                                     haemoglobin_first, haemoglobin_last, nm));
}

void require_fraction(std::string_view name, double value) {
    if (!(value >= 0. && value <= 1.))
        throw InputError(fmt::format("{} = {:g} must lie within [0, 1]", name, value));
}

double mixture(double share, double of, double rest) { return share * of + (1. - share) * rest; }

// Of the epidermis; see SkinScattering::donner_jensen.
double donner_jensen_scattering(double nm) {
    return per_cm * (147.4 * std::pow(nm, -0.22) + 2.2e12 * std::pow(nm, -4.));
}

double jacques_scattering(double nm) {
    return per_cm * (2e5 * std::pow(nm, -1.5) + 2e12 * std::pow(nm, -4.));
}

}  // namespace

double baseline_absorption(double nm, BaselineModel model) {
    require_wavelength(nm);
    return per_cm * (model == BaselineModel::power ? 7.84e8 * std::pow(nm, -3.255)
                                                   : 0.244 + 85.3 * std::exp(-(nm - 154.) / 66.2));
}

double melanin_absorption(double nm, MelaninModel model, double eumelanin) {
    require_wavelength(nm);
    require_fraction("eumelanin", eumelanin);
    if (model == MelaninModel::exponent_3_48) return per_cm * 1.70e12 * std::pow(nm, -3.48);
    const double eu = per_cm * 6.6e11 * std::pow(nm, -3.33);
    if (model == MelaninModel::exponent_3_33) return eu;
    return mixture(eumelanin, eu, per_cm * 2.9e15 * std::pow(nm, -4.75));
}

double blood_absorption(double nm, double oxygenation, double haemoglobin) {
    require_wavelength(nm);
    require_fraction("oxygenation", oxygenation);
    if (!(haemoglobin >= 0.) || !std::isfinite(haemoglobin))
        throw InputError(
            fmt::format("haemoglobin = {:g} g/L must be finite and at least 0", haemoglobin));
    const HaemoglobinExtinction e = haemoglobin_extinction(nm);
    constexpr double molar_mass = 64500.;  // g/mol
    return per_cm * 2.303 * haemoglobin / molar_mass *
           mixture(oxygenation, e.oxygenated, e.deoxygenated);
}

double epidermis_absorption(double nm, double melanin) {
    require_fraction("melanin", melanin);
    return mixture(melanin, melanin_absorption(nm), baseline_absorption(nm));
}

double dermis_absorption(double nm, double blood, double oxygenation) {
    require_fraction("blood", blood);
    return mixture(blood, blood_absorption(nm, oxygenation), baseline_absorption(nm));
}

double epidermis_reduced_scattering(double nm, SkinScattering model) {
    require_wavelength(nm);
    return model == SkinScattering::jacques ? jacques_scattering(nm) : donner_jensen_scattering(nm);
}

double dermis_reduced_scattering(double nm, SkinScattering model) {
    require_wavelength(nm);
    return model == SkinScattering::jacques ? jacques_scattering(nm)
                                            : 0.5 * donner_jensen_scattering(nm);
}

double skin_anisotropy(double nm) {
    require_wavelength(nm);
    return 0.62 + 0.00029 * nm;
}

}  // namespace nacre
