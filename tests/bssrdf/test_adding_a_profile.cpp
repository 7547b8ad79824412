// The example of docs/adding-a-profile.md is a profile as it says.
#include "nacre/bssrdf/radial_integral.h"
#include "nacre/math/error.h"
#include "tests/package/consumer/gaussian_profile.h"
#include "tests/support/doc_code.h"

namespace nacre {

TEST(AddingAProfile, TheExampleAgreesWithItsFormula) {
    const ProfileDescription& gaussian = example::gaussian_profile();
    const auto medium = ProfileMedium::reduced(2., 0., 1.3);
    const auto made = [&](const char* settings) {
        return gaussian.make(
            medium, ParameterValues(gaussian.name, gaussian.options, parse_settings(settings)));
    };
    // Two transport mean free paths of half a millimetre: v = 1 mm^2.
    const auto profile = made("width=2 total=all");
    EXPECT_NEAR(profile->eval(1.), std::exp(-0.5) / (2. * std::numbers::pi), 1e-15);
    const auto value = [&](double r) { return profile->eval(r); };
    for (const double r : {0.1, 1., 5.})
        EXPECT_NEAR(disk_integral(r, 1., value), profile->cumulative(r), 1e-8) << r;
    // Without absorption all light returns.
    EXPECT_NEAR(made("")->total(), 1., 1e-12);
    try {
        made("total=some");
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "gaussian: unknown total 'some'; known are: medium, all");
    }
}

TEST(AddingAProfile, TheCodeOfThePageIsTheCodeThatIsBuilt) {
    const std::vector<test::DocCode> blocks = test::code_of("docs/adding-a-profile.md");
    EXPECT_GE(blocks.size(), 4u);
    for (const test::DocCode& b : blocks)
        EXPECT_TRUE(test::stands_in_its_file(b)) << b.file << ":\n" << b.code;
}

}  // namespace nacre
