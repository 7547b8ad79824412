#include "nacre/measured/model_slopes.h"

#include <ceres/jet.h>

#include "nacre/math/error.h"
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
#include "nacre/reflectance/schlick.h"
#include "nacre/reflectance/schlick_ct.h"
#include "nacre/reflectance/torrance_sparrow.h"
#include "nacre/reflectance/ward.h"

namespace nacre {
namespace {

/// Derivatives at a time: enough for most models, and one or two registers.
constexpr int width = 8;
using Jet = ceres::Jet<double, width>;

struct Request {
    const ValuesD& values;
    std::span<const int> slot;
    int slots;
    std::span<const Vec3d> wi, wo;
    std::span<double> value, slopes;
};

/// Values alone take a fraction of the time. Duals of one derivative go the way of those of many, so
/// that both give one value.
template <template <class, class, class> class Model>
void answer_values(const Request& r) {
    using Thin = ceres::Jet<double, 1>;
    Values<Thin, Thin> values;
    values.option = r.values.option;
    for (int i = 0; i < max_parameters; ++i) values.set_scalar(i, Thin(r.values.color[i]));
    const auto model = make_model_of<Model, double, Thin, Thin>(values);
    for (std::size_t k = 0; k < r.wi.size(); ++k) r.value[k] = model.eval(r.wi[k], r.wo[k]).a;
}

template <template <class, class, class> class Model>
void answer(const Request& r) {
    if (r.slots == 0) return answer_values<Model>(r);
    for (int first = 0; first < r.slots; first += width) {
        Values<Jet, Jet> jets;
        jets.option = r.values.option;
        for (int i = 0; i < max_parameters; ++i) {
            Jet x(r.values.color[i]);
            if (i < int(r.slot.size()) && r.slot[i] >= first && r.slot[i] < first + width)
                x.v[r.slot[i] - first] = 1.;
            jets.set_scalar(i, x);
        }
        const auto model = make_model_of<Model, double, Jet, Jet>(jets);
        const int count = std::min(width, r.slots - first);
        for (std::size_t k = 0; k < r.wi.size(); ++k) {
            const Jet f = model.eval(r.wi[k], r.wo[k]);
            r.value[k] = f.a;
            for (int j = 0; j < count; ++j) r.slopes[k * r.slots + first + j] = f.v[j];
        }
    }
}

}  // namespace

void eval_with_slopes(const ModelDescription& model, const ValuesD& values,
                      std::span<const int> slot, int slots, std::span<const Vec3d> wi,
                      std::span<const Vec3d> wo, std::span<double> value,
                      std::span<double> slopes) {
    const Request request{values, slot, slots, wi, wo, value, slopes};
#define NACRE_ANSWER(Model) \
    if (model.name == Model<double, double, double>::describe().name) return answer<Model>(request);
    NACRE_MODELS(NACRE_ANSWER)
#undef NACRE_ANSWER
    throw InputError(
        fmt::format("{} cannot be fitted: it is not in the list of models", model.name));
}

}  // namespace nacre
