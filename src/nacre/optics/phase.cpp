#include "nacre/optics/phase.h"

#include <fmt/format.h>

#include <array>

#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

constexpr std::array<std::string_view, 9> all_names = {
    "isotropic", "rayleigh", "mie_hazy",        "mie_murky",  "mie_murky_33",
    "hg",        "schlick",  "cornette_shanks", "two_term_hg"};

float asymmetry(std::string_view phase, std::string_view parameter, float value) {
    if (!(value > -1.f && value < 1.f))
        throw InputError(fmt::format("phase function {}: {} = {} must lie between -1 and 1", phase,
                                     parameter, value));
    return value;
}

}  // namespace

PhaseFunction PhaseFunction::henyey_greenstein(float g) {
    return PhaseFunction(Kind::hg, asymmetry("hg", "g", g));
}

PhaseFunction PhaseFunction::schlick(float k) {
    return PhaseFunction(Kind::schlick, asymmetry("schlick", "k", k));
}

PhaseFunction PhaseFunction::cornette_shanks(float g) {
    return PhaseFunction(Kind::cornette_shanks, asymmetry("cornette_shanks", "g", g));
}

PhaseFunction PhaseFunction::two_term_hg(float first, float g1, float g2) {
    if (!(first >= 0.f && first <= 1.f))
        throw InputError(fmt::format(
            "phase function two_term_hg: the share {} of the first term must lie in [0, 1]",
            first));
    return PhaseFunction(Kind::two_term_hg, first, asymmetry("two_term_hg", "g1", g1),
                         asymmetry("two_term_hg", "g2", g2));
}

std::span<const std::string_view> PhaseFunction::names() { return all_names; }

std::string_view PhaseFunction::name() const { return all_names[static_cast<std::size_t>(kind_)]; }

PhaseFunction PhaseFunction::named(std::string_view name, float parameter) {
    // two_term_hg needs three numbers and is left out here.
    const auto simple = names().first(all_names.size() - 1);
    const int i = find_name(name, simple);
    if (i < 0) throw InputError(unknown_name("phase function", name, simple));
    switch (const Kind kind = static_cast<Kind>(i)) {
        case Kind::hg:
            return henyey_greenstein(parameter);
        case Kind::schlick:
            return schlick(parameter);
        case Kind::cornette_shanks:
            return cornette_shanks(parameter);
        default:
            return PhaseFunction(kind);
    }
}

}  // namespace nacre
