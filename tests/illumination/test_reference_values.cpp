// The published formulas against values computed with 40 digits by others than this code.
#include "nacre/illumination/all_models.h"
#include "tests/illumination/reference.h"

namespace nacre::illumination {
namespace {

template <class D>
void check_all_models(double tolerance) {
    for (const Description* model : models()) {
        const auto& vectors = reference()["models"][fmt::format("m{:02}", model->number)];
        ASSERT_EQ(vectors.size(), 12u) << model->number;
        for (const auto& v : vectors) {
            const double expected = v["value"].get<double>();
            const double value = Case<D>(*model, v).value();
            EXPECT_NEAR(value, expected, std::max(tolerance * std::abs(expected), 1e-12))
                << model->number << " " << v["params"].dump();
        }
    }
}

TEST(IlluminationReference, EveryModelInDoublePrecision) { check_all_models<double>(1e-9); }
TEST(IlluminationReference, EveryModelInSinglePrecision) { check_all_models<float>(2e-5); }

void expect_relative(double value, double expected, double tolerance = 1e-9) {
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

TEST(IlluminationReference, DistributionsFromTheHalfHeightAngle) {
    for (const auto& v : reference()["scalars"]["beta_conversion"]) {
        const double beta = radians(v["params"]["beta_deg"].get<double>());
        const auto& expected = v["values"];
        expect_relative(phong_exponent_of_beta(beta), expected["Ns"]);
        expect_relative(torrance_sparrow_of_beta(beta), expected["C1"]);
        expect_relative(trowbridge_reitz_of_beta(beta), expected["C2"]);
        expect_relative(beckmann_slope_of_beta(beta), expected["m"]);
        expect_relative(unclipped_slope_of_beta(beta), expected["m_unclipped"]);
    }
}

TEST(IlluminationReference, PlateAndInterface) {
    for (const auto& v : reference()["scalars"]["hall_plate"]) {
        const double n = v["params"]["n"].get<double>();
        const Vec3d up{0., 0., 1.};
        expect_relative(HallTransparency<double>{n}.transmittance(up), v["values"]["plate"]);
        expect_relative(2. * n / (n * n + 1.), v["values"]["closed_2n"]);
        expect_relative(interface_transmittance(n), v["values"]["interface"]);
    }
}

TEST(IlluminationReference, GeometricAttenuation) {
    for (const auto& v : reference()["scalars"]["masking"]) {
        const auto angle = [&](const char* name) {
            return radians(v["params"][name].get<double>());
        };
        const double m = v["params"]["m"].get<double>();
        const Vec3d wi = polar(angle("theta_i_deg")),
                    wo = polar(angle("theta_o_deg"), angle("dphi_deg"));
        const auto& expected = v["values"];
        expect_relative(geometric_torrance_sparrow(wi, wo, half_vector(wi, wo)),
                        expected["vcavity"]);
        expect_relative(geometric_sancer(wi, wo, m), expected["sancer"]);
        expect_relative(self_shadowing_smith(wi, m) * self_shadowing_smith(wo, m),
                        expected["he_S"]);
    }
}

TEST(IlluminationReference, HallsBeckmannDistribution) {
    for (const auto& v : reference()["scalars"]["ndf"])
        expect_relative(
            distribution_hall_beckmann(polar(radians(v["params"]["theta_deg"].get<double>())),
                                       v["params"]["m"].get<double>()),
            v["values"]["hall_beckmann"]);
}

}  // namespace
}  // namespace nacre::illumination
