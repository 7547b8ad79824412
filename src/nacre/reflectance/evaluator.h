#pragma once
// A model behind one interface, whatever its type: `Evaluator` takes the values of its parameters
// as a flat list in the order of its description, so that who evaluates (a material with textures,
// a table, a fit) needs to know nothing else. `EvaluatorOf` (evaluator_of.h) makes one of a model.
#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"
#include "nacre/reflectance/bsdf.h"
#include "nacre/reflectance/description.h"

namespace nacre {

inline constexpr int max_parameters = 32;

/// Values of a model's parameters by position: spectra in `color`, scalars in `scalar`, choices and
/// integers in `option`. Where C and S are the same type, scalars stand in `color` too, because the
/// type of a member does not tell then which it is; `set_scalar` sees to it.
template <class C, class S>
struct Values {
    std::array<C, max_parameters> color;
    std::array<S, max_parameters> scalar;
    std::array<int, max_parameters> option;

    Values() : color{}, scalar{}, option{} {}
    /// The first n of another, for a model with as many parameters.
    Values(const Values& other, int n) {
        std::copy_n(other.color.begin(), n, color.begin());
        std::copy_n(other.scalar.begin(), n, scalar.begin());
        std::copy_n(other.option.begin(), n, option.begin());
    }

    void set_color(int i, C value) { color[i] = value; }
    void set_scalar(int i, S value) {
        scalar[i] = value;
        if constexpr (std::is_same_v<C, S>) color[i] = value;
    }
};
using ValuesD = Values<double, double>;
using ValuesF = Values<float, float>;
using ValuesS = Values<Spectral, float>;

class Evaluator {
  public:
    virtual ~Evaluator() = default;

    virtual const ModelDescription& description() const = 0;
    /// The names that the model's own `parameters` visits: those of the description, in its order.
    virtual std::vector<std::string> parameter_names() const = 0;

    /// BRDF, sr^-1, without cosine; 0 below the horizon. Mirror parts are not in it.
    virtual double eval(const ValuesD& values, const Vec3d& wi, const Vec3d& wo) const = 0;
    virtual float eval(const ValuesF& values, const Vec3f& wi, const Vec3f& wo) const = 0;
    virtual Spectral eval(const ValuesS& values, const Vec3f& wi, const Vec3f& wo) const = 0;
    /// Many pairs of directions, in packs as wide as the registers. Spans of equal length.
    virtual void eval_many(const ValuesF& values, std::span<const Vec3f> wi,
                           std::span<const Vec3f> wo, std::span<float> out) const = 0;

    /// Draws wi; u1 in [0, 1) chooses the lobe. It may lie below the horizon: that sample is lost.
    virtual Vec3f sample(const ValuesS& values, const Vec3f& wo, float u1, Vec2f u2) const = 0;
    /// Density of `sample`, sr^-1.
    virtual double pdf(const ValuesD& values, const Vec3d& wi, const Vec3d& wo) const = 0;

    /// The model with these values, prepared, as a surface that is black from below: its mirror
    /// part, if there is one, a delta component beside the rest.
    virtual const Bsdf& bind(const ValuesS& values, BsdfScratch& scratch) const = 0;

    /// Whether a part of the light is mirrored without blur, beside what `eval` gives.
    virtual bool has_mirror() const = 0;
    /// The share of the light from the mirror direction of wo that is mirrored to wo.
    virtual Spectral mirror(const ValuesS& values, const Vec3f& wo) const = 0;
    virtual double mirror(const ValuesD& values, const Vec3d& wo) const = 0;

    /// The albedo of light that comes from wi, without the mirror part, if a closed form is known.
    virtual std::optional<double> albedo(const ValuesD& values, const Vec3d& wi) const = 0;
};

/// The evaluator of a model; explicitly instantiated in the file of its family (family_*.cpp).
template <template <class, class, class> class Model>
const Evaluator& evaluator_of();

}  // namespace nacre
