// Albedos of lobes far narrower than the first cells of the quadrature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "nacre/reflectance/albedo.h"
#include "tests/reflectance/family_data.h"

namespace nacre {
namespace {

Albedo albedo(const char* model, const char* settings, double degrees) {
    return directional_albedo(AnyModel(find_evaluator(model), parse_settings(settings)),
                              test::at_degrees(degrees));
}

TEST(NarrowLobes, OfFacetsThatReflectEverythingLoseNothing) {
    // Shadowing of GGX facets and the light that leaves below the horizon fall as alpha.
    for (const double degrees : {0., 30., 60.}) {
        const Albedo ggx = albedo("ggx", "fresnel=one alpha=1e-4", degrees);
        EXPECT_NEAR(ggx.value, 1., 1e-6) << degrees;
        EXPECT_LT(ggx.error, 1e-6) << degrees;
        const Albedo narrow = albedo("ggx", "fresnel=one alpha_u=1e-4 alpha_v=1e-3", degrees);
        EXPECT_NEAR(narrow.value, 1., 1e-5) << degrees;
    }
    // Ward's lobe keeps all of the light at normal incidence as alpha goes to 0 (Duer's form).
    EXPECT_NEAR(albedo("ward", "kd=0 ks=1 alpha=5e-4", 0.).value, 1., 1e-5);
}

TEST(NarrowLobes, OfPhongsCosineHaveTheirClosedForm) {
    // The mean cosine of a lobe cos^n about a direction R that the horizon does not cut is
    // (n + 1) / (n + 2) R.z, and (n + 2) / (n + 1) normalises: R.z is left, whatever the exponent.
    for (const char* n : {"1000", "100000", "1000000"})
        for (const double degrees : {0., 60., 80.}) {
            const Albedo a = albedo("phong", fmt::format("kd=0 ks=1 n={}", n).c_str(), degrees);
            EXPECT_NEAR(a.value, std::cos(degrees * std::numbers::pi / 180), 1e-6)
                << n << " " << degrees;
        }
}

}  // namespace
}  // namespace nacre
