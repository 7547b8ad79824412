#include "nacre/bssrdf/medium.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "nacre/math/error.h"

namespace nacre {

void check(const ProfileMedium& m) {
    const auto demand = [](bool holds, std::string_view name, double value,
                           std::string_view range) {
        if (!holds)
            throw InputError(
                fmt::format("translucent medium: {} = {:g} must be {}", name, value, range));
    };
    const auto coefficient = [&](std::string_view name, double value) {
        demand(value >= 0. && std::isfinite(value), name, value, "finite and at least 0");
    };
    coefficient("sigma_s", m.sigma_s);
    coefficient("sigma_a", m.sigma_a);
    demand(m.sigma_t() > 0., "sigma_s + sigma_a", m.sigma_t(), "positive");
    demand(m.g > -1. && m.g < 1., "g", m.g, "between -1 and 1");
    demand(m.eta > 0. && std::isfinite(m.eta), "eta", m.eta, "positive and finite");
}

}  // namespace nacre
