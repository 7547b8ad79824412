#include <fmt/format.h>

#include "nacre/catalogue/catalogue.h"
#include "nacre/math/error.h"
#include "nacre/optics/dispersion.h"

namespace nacre {

namespace {

struct Named {
    std::string_view name;
    float index;
};
constexpr Named dielectrics[] = {
    {"vacuum", 1.f},       {"helium", 1.000036f},        {"hydrogen", 1.000132f},
    {"air", 1.000277f},    {"carbon dioxide", 1.00045f}, {"water", 1.333f},
    {"acetone", 1.36f},    {"ethanol", 1.361f},          {"carbon tetrachloride", 1.461f},
    {"glycerol", 1.4729f}, {"benzene", 1.501f},          {"silicone oil", 1.52045f},
    {"bromine", 1.661f},   {"water ice", 1.31f},         {"fused quartz", 1.458f},
    {"pyrex", 1.47f},      {"acrylic glass", 1.49f},     {"polypropylene", 1.49f},
    {"bk7", 1.5046f},      {"sodium chloride", 1.544f},  {"amber", 1.55f},
    {"pet", 1.575f},       {"diamond", 2.419f}};

// Quan and Fry 1995, Empirical equation for the index of refraction of seawater, Appl. Opt. 34:
// fresh water at 20 C. Measured from 400 to 700 nm; used beyond, where it stays smooth.
DielectricIndex water() {
    std::vector<float> nm, n;
    for (double l = visible_min; l <= visible_max; l += 10.) {
        nm.push_back(static_cast<float>(l));
        n.push_back(static_cast<float>(1.31405 - 2.02e-6 * 20. * 20. +
                                       (15.868 - 0.00423 * 20.) / l - 4382. / (l * l) +
                                       1.1455e6 / (l * l * l)));
    }
    return DielectricIndex::tabulated(std::move(nm), std::move(n));
}

void require_positive(std::string_view what, float value) {
    if (!(value > 0.f && std::isfinite(value)))
        throw InputError(fmt::format("index of refraction: {} {} must be positive", what, value));
}

}  // namespace

DielectricIndex::DielectricIndex(float n) {
    require_positive("n =", n);
    k_[0] = n;
}

DielectricIndex DielectricIndex::cauchy(float a, float b, float c) {
    DielectricIndex index;
    index.formula_ = Formula::cauchy;
    index.k_ = {a, b, c, 0.f, 0.f, 0.f};
    require_positive("Cauchy's formula at 360 nm gives", index.at(visible_min));
    require_positive("Cauchy's formula at 830 nm gives", index.at(visible_max));
    return index;
}

DielectricIndex DielectricIndex::sellmeier(std::array<float, 3> b, std::array<float, 3> c) {
    DielectricIndex index;
    index.formula_ = Formula::sellmeier;
    index.k_ = {b[0], b[1], b[2], c[0], c[1], c[2]};
    require_positive("Sellmeier's formula at 360 nm gives", index.at(visible_min));
    require_positive("Sellmeier's formula at 830 nm gives", index.at(visible_max));
    return index;
}

DielectricIndex DielectricIndex::tabulated(std::vector<float> nm, std::vector<float> n) {
    if (nm.empty() || nm.size() != n.size())
        throw InputError(fmt::format(
            "index of refraction: {} wavelengths and {} values; give as many of each, at least one",
            nm.size(), n.size()));
    for (std::size_t i = 0; i < nm.size(); ++i) {
        require_positive("value", n[i]);
        require_positive("wavelength", nm[i]);
        if (i > 0 && nm[i] <= nm[i - 1])
            throw InputError(fmt::format(
                "index of refraction: wavelength {} nm follows {} nm; sort by wavelength", nm[i],
                nm[i - 1]));
    }
    DielectricIndex index;
    index.formula_ = Formula::tabulated;
    index.nm_ = std::move(nm);
    index.n_ = std::move(n);
    return index;
}

float DielectricIndex::at(float nm) const {
    const float l2 = nm * nm * 1e-6f;  // square micrometres
    switch (formula_) {
        case Formula::constant:
            break;
        case Formula::cauchy:
            return k_[0] + k_[1] / l2 + k_[2] / (l2 * l2);
        case Formula::sellmeier:
            return std::sqrt(1.f + k_[0] * l2 / (l2 - k_[3]) + k_[1] * l2 / (l2 - k_[4]) +
                             k_[2] * l2 / (l2 - k_[5]));
        case Formula::tabulated: {
            if (nm <= nm_.front()) return n_.front();
            if (nm >= nm_.back()) return n_.back();
            const auto i = static_cast<std::size_t>(std::upper_bound(nm_.begin(), nm_.end(), nm) -
                                                    nm_.begin());
            const float f = (nm - nm_[i - 1]) / (nm_[i] - nm_[i - 1]);
            return n_[i - 1] * (1.f - f) + n_[i] * f;
        }
    }
    return k_[0];
}

Spectral DielectricIndex::eval(const Wavelengths& w) const {
    if (formula_ == Formula::constant || w.mode == ColorMode::rgb_bands)
        return Spectral(at(sodium_d));
    Spectral n;
    for (int i = 0; i < Spectral::size; ++i) n.set(i, at(w.lambda[i]));
    return n;
}

namespace {

const Catalogue<Named>& named() {
    static const Catalogue<Named> all("dielectric", dielectrics);
    return all;
}

struct Dispersive {
    std::string_view name;
    DielectricIndex (*make)();
};
constexpr Dispersive dispersive[] = {
    {"bk7",
     [] {
         return DielectricIndex::sellmeier({1.03961212f, 0.231792344f, 1.01046945f},
                                           {0.00600069867f, 0.0200179144f, 103.560653f});
     }},
    {"n-sf11",
     [] {
         return DielectricIndex::sellmeier({1.73759695f, 0.313747346f, 1.89878101f},
                                           {0.013188707f, 0.0623068142f, 155.23629f});
     }},
    {"fused quartz",  // the paper gives the roots of c_i
     [] {
         return DielectricIndex::sellmeier(
             {0.6961663f, 0.4079426f, 0.8974794f},
             {0.0684043f * 0.0684043f, 0.1162414f * 0.1162414f, 9.896161f * 9.896161f});
     }},
    {"diamond",
     [] {
         return DielectricIndex::sellmeier({0.3306f, 4.3356f, 0.f},
                                           {0.1750f * 0.1750f, 0.1060f * 0.1060f, 0.f});
     }},
    {"water", water},
};
const Catalogue<Dispersive>& dispersive_named() {
    static const Catalogue<Dispersive> all("dispersive dielectric", dispersive);
    return all;
}

}  // namespace

std::vector<std::string_view> dielectric_names() { return named().names(); }
std::vector<std::string_view> dispersive_names() { return dispersive_named().names(); }

float dielectric_index(std::string_view name) { return named().find(name).index; }

DielectricIndex dispersive_dielectric(std::string_view name) {
    return dispersive_named().find(name).make();
}

}  // namespace nacre
