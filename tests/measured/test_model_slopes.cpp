#include "nacre/measured/model_slopes.h"

#include <gtest/gtest.h>

#include "nacre/math/error.h"
#include "nacre/reflectance/registry.h"

namespace nacre {
namespace {

const std::vector<Vec3d> wi{normalize(Vec3d{0.5, 0.2, 0.8}), normalize(Vec3d{-0.1, 0.7, 0.6})},
    wo{normalize(Vec3d{-0.35, -0.3, 0.9}), normalize(Vec3d{0.2, -0.6, 0.8})};

/// Every continuous parameter with a derivative of its own, against central differences.
void check(const std::string& name, const char* settings) {
    const AnyModel model = make_model(name, parse_settings(settings));
    const auto& parameters = model.description().parameters;
    const ValuesD values = model.values_double(550.);
    std::vector<int> slot(parameters.size(), -1);
    int slots = 0;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].kind == ParameterKind::spectrum ||
            parameters[i].kind == ParameterKind::scalar)
            slot[i] = slots++;
    std::vector<double> value(wi.size()), slopes(wi.size() * slots);
    eval_with_slopes(model.description(), values, slot, slots, wi, wo, value, slopes);
    std::vector<double> alone(wi.size()), none;
    eval_with_slopes(model.description(), values, std::vector<int>(parameters.size(), -1), 0, wi,
                     wo, alone, none);
    for (std::size_t k = 0; k < wi.size(); ++k) {
        EXPECT_DOUBLE_EQ(value[k], model.eval(wi[k], wo[k])) << name;
        EXPECT_DOUBLE_EQ(alone[k], value[k]) << name;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (slot[i] < 0) continue;
            const double step = 1e-5 * std::max(1., std::abs(values.scalar[i]));
            ValuesD low = values, high = values;
            low.set_scalar(int(i), values.scalar[i] - step);
            high.set_scalar(int(i), values.scalar[i] + step);
            const double slope = (model.evaluator().eval(high, wi[k], wo[k]) -
                                  model.evaluator().eval(low, wi[k], wo[k])) /
                                 (2. * step);
            EXPECT_NEAR(slopes[k * slots + slot[i]], slope, 1e-7 + 1e-6 * std::abs(slope))
                << name << " by " << parameters[i].name;
        }
    }
}

}  // namespace

TEST(ModelSlopes, AgreeWithDifferences) {
    check("lambert", "");
    check("ward", "alpha_u=0.3 alpha_v=0.5");
    check("cook_torrance", "fresnel=conductor m=0.4");
    check("he_torrance", "sigma0=0.3 tau=1.2");
    check("he_torrance", "sigma0=1.5 tau=6");
    check("poulin_fournier", "n=20 spacing=2.3 depth=0.6");
    // More parameters than there are derivatives at a time.
    check("lafortune",
          "kd=0.1 ks=0.2 n=5 ks2=0.1 cx2=-0.8 cy2=-0.9 cz2=0.7 n2=3 ks3=0.2 cxy3=0.1 n3=4");
}

TEST(ModelSlopes, ParametersThatShareASlotMoveTogether) {
    const AnyModel model = make_model("ward", parse_settings("alpha=0.3"));
    std::vector<double> value(2), together(2), apart(4);
    const std::vector<int> both{-1, -1, -1, 0, 0}, each{-1, -1, -1, 0, 1};
    const ValuesD values = model.values_double(550.);
    eval_with_slopes(model.description(), values, both, 1, wi, wo, value, together);
    eval_with_slopes(model.description(), values, each, 2, wi, wo, value, apart);
    for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(together[k], apart[2 * k] + apart[2 * k + 1], 1e-12 * std::abs(together[k]));
}

TEST(ModelSlopes, OfWhatIsNoModel) {
    ModelDescription other;
    other.name = "velvet";
    std::vector<double> value(2), slopes;
    try {
        eval_with_slopes(other, {}, {}, 0, wi, wo, value, slopes);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(), "velvet cannot be fitted: it is not in the list of models");
    }
}

}  // namespace nacre
