// Models on dual numbers: derivatives by all continuous parameters, for fitting. Needs the headers
// of libceres-dev and libeigen3-dev; without them there is nothing to test.
#if __has_include(<ceres/jet.h>) && __has_include(<Eigen/Core>)
#include <ceres/jet.h>

#include "nacre/reflectance/blinn_phong.h"
#include "nacre/reflectance/blinn_torrance_sparrow.h"
#include "nacre/reflectance/cook_torrance.h"
#include "nacre/reflectance/eon.h"
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/ggx_smith.h"
#include "nacre/reflectance/he_torrance.h"
#include "nacre/reflectance/lafortune.h"
#include "nacre/reflectance/lambert.h"
#include "nacre/reflectance/metallic_roughness.h"
#include "nacre/reflectance/models.h"
#include "nacre/reflectance/oren_nayar.h"
#include "nacre/reflectance/phong.h"
#include "nacre/reflectance/poulin_fournier.h"
#include "nacre/reflectance/registry.h"
#include "nacre/reflectance/schlick_ct.h"
#include "nacre/reflectance/torrance_sparrow.h"
#include "nacre/reflectance/ward.h"

namespace nacre {
namespace {

constexpr int size = 32;
using Jet = ceres::Jet<double, size>;

/// Derivatives at the examples of the description against central differences.
template <template <class, class, class> class Model>
void check_derivatives() {
    const ModelDescription& m = Model<double, double, double>::describe();
    const Vec3d wi = normalize(Vec3d{0.5, 0.2, 0.8}), wo = normalize(Vec3d{-0.35, -0.3, 0.9});
    for (const Behaviour& b : m.behaviours) {
        const std::string text = fmt::format("{} {}", b.options, b.examples.front());
        const ValuesD values =
            AnyModel(evaluator_of<Model>(), parse_settings(text)).values_double(550.);
        Values<Jet, Jet> jets;
        std::vector<int> varied;
        for (std::size_t i = 0; i < m.parameters.size(); ++i) {
            jets.option[i] = values.option[i];
            const ParameterKind kind = m.parameters[i].kind;
            if (kind == ParameterKind::wavelength) jets.set_color(i, Jet(values.color[i]));
            if (kind != ParameterKind::spectrum && kind != ParameterKind::scalar) continue;
            jets.set_scalar(i, Jet(values.scalar[i], int(varied.size())));
            varied.push_back(int(i));
        }
        ASSERT_LE(varied.size(), std::size_t(size));
        const Jet f = make_model_of<Model, double, Jet, Jet>(jets).eval(wi, wo);
        const auto plain = [&](const ValuesD& v) {
            return make_model_of<Model, double, double, double>(v).eval(wi, wo);
        };
        EXPECT_DOUBLE_EQ(f.a, plain(values)) << m.name << " " << text;
        for (std::size_t k = 0; k < varied.size(); ++k) {
            const int i = varied[k];
            const double step = 1e-5 * std::max(1., std::abs(values.scalar[i]));
            ValuesD low = values, high = values;
            low.set_scalar(i, values.scalar[i] - step);
            high.set_scalar(i, values.scalar[i] + step);
            const double slope = (plain(high) - plain(low)) / (2. * step);
            EXPECT_NEAR(f.v[k], slope, 1e-7 + 1e-6 * std::abs(slope))
                << m.name << " " << text << " by " << m.parameters[i].name;
        }
    }
}

}  // namespace

TEST(DualNumbers, GiveTheDerivativesOfEveryModel) {
#define NACRE_CHECK_MODEL(Model) check_derivatives<Model>();
    NACRE_MODELS(NACRE_CHECK_MODEL)
#undef NACRE_CHECK_MODEL
}

}  // namespace nacre
#endif
