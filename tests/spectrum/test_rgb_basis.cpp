#include "nacre/spectrum/rgb_basis.h"

#include <gtest/gtest.h>

#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"

namespace nacre {
namespace {

TEST(RgbBasis, ColoursComeBack) {
    for (const Vec3f& rgb :
         {Vec3f{0.2f, 0.5f, 0.9f}, Vec3f{0.9f, 0.1f, 0.1f}, Vec3f{0.3f, 0.3f, 0.3f},
          Vec3f{3.f, 1.f, 2.f}, Vec3f{0.f, 0.7f, 0.f}, Vec3f{0.4f, 0.4f, 0.1f}, Vec3f{}}) {
        Vec3d xyz;
        double white = 0.;
        for (int nm = 360; nm <= 830; ++nm) {
            const float r = RgbBasis(Spectral(float(nm))).eval(rgb)[0];
            EXPECT_GE(r, 0.f);
            const Vec3d seen(d65_unit(float(nm)) * cie_xyz(float(nm)));
            xyz += double(r) * seen;
            white += seen.y;
        }
        const Vec3f back = xyz_to_rgb(Vec3f(xyz / white));
        // Round trip of uplift.h a spectrum of the mixture, and steps of 1 nm.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(back[c], rgb[c], 2e-3f * std::max({rgb.x, rgb.y, rgb.z})) << c;
    }
}

TEST(RgbBasis, IsContinuousAndScales) {
    const RgbBasis basis({420.f, 500.f, 580.f, 640.f});
    const Spectral a = basis.eval({0.5f, 0.5f - 1e-6f, 0.2f}),
                   b = basis.eval({0.5f - 1e-6f, 0.5f, 0.2f}), c = basis.eval({1.f, 1.f, 0.4f});
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(a[k], b[k], 1e-5f);
        EXPECT_NEAR(2.f * a[k], c[k], 1e-5f);
    }
    EXPECT_EQ(basis.eval({0.7f, 0.7f, 0.7f})[2], 0.7f);
}

}  // namespace
}  // namespace nacre
