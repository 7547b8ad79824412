#include "nacre/reflectance/lambert.h"

#include "tests/reflectance/reference.h"

namespace nacre {

TEST(Lambert, AgreesWithTheReferenceVectors) {
    const auto data = test::reflectance_vectors();
    if (data.is_null()) GTEST_SKIP() << "shared reference data are absent";
    for (const auto& v : data["models"]["lambert"]["vectors"]) {
        const Lambert<double> model{v["params"]["kd"].get<double>()};
        const double expected = v["value"].get<double>();
        EXPECT_NEAR(model.eval(test::vector(v["wi"]), test::vector(v["wo"])), expected,
                    1e-10 * expected)
            << v["id"];
    }
    for (const auto& v : data["models"]["pdf_cosine"]["vectors"])
        EXPECT_NEAR(Lambert<double>{}.pdf(test::vector(v["wo"]), test::vector(v["wi"])),
                    v["value"].get<double>(), 1e-10)
            << v["id"];
}

TEST(Lambert, IsBlackBelowTheHorizon) {
    const Lambert<float, Spectral> model{Spectral(1.f)};
    const Vec3f up{0.6f, 0.f, 0.8f}, down{0.6f, 0.f, -0.8f};
    EXPECT_GT(model.eval(up, up)[0], 0.f);
    EXPECT_EQ(model.eval(up, down)[0], 0.f);
    EXPECT_EQ(model.eval(down, up)[0], 0.f);
    EXPECT_EQ(model.eval(down, down)[0], 0.f);
    EXPECT_EQ(model.pdf(down, up), 0.f);
}

TEST(Lambert, RunsOnPacksOfDirections) {
    using Pack = Lanes<float, 4>;
    const Lambert<Pack> model{Pack(0.5f)};
    const Vec3<Pack> wi{Pack(0.6f), Pack(0.f), Pack(0.8f, -0.8f, 0.8f, -0.8f)};
    const Vec3<Pack> wo{Pack(0.f), Pack(0.6f), Pack(0.8f, 0.8f, -0.8f, -0.8f)};
    const Pack f = model.eval(wi, wo);
    EXPECT_FLOAT_EQ(f[0], 0.15915494f);
    for (int i = 1; i < 4; ++i) EXPECT_EQ(f[i], 0.f);
}

}  // namespace nacre
