// What answers many pairs of directions at once is written in packs that clang does not know. Here
// single calls stand in: the readers are under test, and their answers are the same but for rounding.
#include <algorithm>

#include "nacre/measured/merl.h"
#include "nacre/measured/rgl_brdf.h"

namespace nacre {

void MerlBrdf::eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out,
                         std::span<bool> known) const {
    for (std::size_t i = 0; i < wi.size(); ++i) {
        const auto value = eval_float(wi[i], wo[i]);
        known[i] = value.has_value();
        for (std::size_t c = 0; c < 3 && value; ++c) out[3 * i + c] = (*value)[c];
    }
}

void RglBrdf::eval_many(std::span<const Vec3f> given, std::span<const Vec3f> other,
                        std::span<float> out, std::span<float> pdf) const {
    const std::size_t n = std::size_t(t_.channels);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const auto row = out.empty() ? out : out.subspan(i * n, n);
        const auto density = eval_pdf(given[i], other[i], row);
        if (!density) std::ranges::fill(row, 0.f);
        if (!pdf.empty()) pdf[i] = density.value_or(0.f);
    }
}

}  // namespace nacre
