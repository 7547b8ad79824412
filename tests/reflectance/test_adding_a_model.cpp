// The example of docs/adding-a-model.md is a model as it says.
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/check.h"
#include "nacre/reflectance/evaluator_of.h"
#include "tests/package/consumer/minnaert.h"
#include "tests/support/doc_code.h"

namespace nacre {

TEST(AddingAModel, TheExampleAgreesWithItsFormula) {
    const AnyModel model(evaluator_of<Minnaert>(), parse_settings("rho=0.6 k=2"));
    // 0.6 * 3 / (2 pi) * 0.8 * 0.6
    const Vec3d wi{0.6, 0., 0.8}, wo{0., -0.8, 0.6};
    EXPECT_NEAR(model.eval(wi, wo), 0.13750987083, 1e-10);
    EXPECT_NEAR(directional_albedo(model, wi).value, 0.6 * 0.8, 1e-7);
    EXPECT_DOUBLE_EQ(*model.albedo(wi), 0.6 * 0.8);
    std::vector<Vec3f> a(20, Vec3f(wi)), b(20, Vec3f(wo));
    std::vector<float> out(20);
    model.eval_many(a, b, out);
    for (float f : out) EXPECT_NEAR(f, 0.13750987f, 1e-6f);
}

TEST(AddingAModel, TheExamplePassesTheChecks) {
    for (const CheckOutcome& c : check_model(evaluator_of<Minnaert>()))
        EXPECT_TRUE(c.passed) << c.name << ": " << c.detail;
}

TEST(AddingAModel, TheCodeOfThePageIsTheCodeThatIsBuilt) {
    const std::vector<test::DocCode> blocks = test::code_of("docs/adding-a-model.md");
    EXPECT_GE(blocks.size(), 4u);
    for (const test::DocCode& b : blocks)
        EXPECT_TRUE(test::stands_in_its_file(b)) << b.file << ":\n" << b.code;
}

}  // namespace nacre
