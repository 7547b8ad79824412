#pragma once
// From a model to its evaluator. Heavy: only the files that instantiate models include it.
#include "nacre/math/lanes_wide.h"
#include "nacre/reflectance/evaluator.h"
#include "nacre/reflectance/model.h"

namespace nacre {

/// A model of given number types with its parameters set.
template <template <class, class, class> class Model, class D, class P, class S, class C, class V>
Model<D, P, S> make_model_of(const Values<C, V>& values) {
    Model<D, P, S> model{};
    int i = 0;
    Model<D, P, S>::parameters(model, [&]<class T>(std::string_view, T& member) {
        if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>)
            member = static_cast<T>(values.option[i]);
        else if constexpr (std::is_same_v<T, C>)
            member = values.color[i];
        else
            member = values.scalar[i];
        ++i;
    });
    if constexpr (requires { model.prepare(); }) model.prepare();
    return model;
}

namespace evaluator_detail {

/// Component `c` of N vectors that lie one after the other in three registers.
template <int c>
Wide component(Wide first, Wide second, Wide third) {
    constexpr int n = Wide::size;
    typename Mask<float, n>::Native from_two, from_three;
    for (int i = 0; i < n; ++i) {
        const int position = 3 * i + c;
        from_two[i] = position < 2 * n ? position : 0;
        from_three[i] = position < 2 * n ? i : position - n;
    }
    return Wide::from(
        __builtin_shuffle(__builtin_shuffle(first.v, second.v, from_two), third.v, from_three));
}

/// N vectors as three packs.
inline Vec3<Wide> load(const Vec3f* v) {
    static_assert(sizeof(Vec3f) == 3 * sizeof(float));
    const float* p = &v->x;
    const Wide first = Wide::load(p), second = Wide::load(p + Wide::size),
               third = Wide::load(p + 2 * Wide::size);
    return {component<0>(first, second, third), component<1>(first, second, third),
            component<2>(first, second, third)};
}

}  // namespace evaluator_detail

/// A model of four wavelengths, set and prepared, as a path meets it.
template <class Model>
class ModelBsdf final : public Bsdf {
  public:
    explicit ModelBsdf(const Model& model) : model_(model) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        if (!(wo.z > 0.f && wi.z > 0.f)) return Spectral(0.f);
        return model_.eval(wi, wo) * wi.z;
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override {
        if (!(wo.z > 0.f && wi.z > 0.f)) return 0.f;
        return model_.pdf(wi, wo) * (1.f - mirror_probability(wo));
    }
    BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const override {
        if (!(wo.z > 0.f && wi.z > 0.f)) return {Spectral(0.f), 0.f};
        return {model_.eval(wi, wo) * wi.z, model_.pdf(wi, wo) * (1.f - mirror_probability(wo))};
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        if (!(wo.z > 0.f)) return std::nullopt;
        BsdfSample s;
        const float mirror = mirror_probability(wo);
        if constexpr (has_mirror)
            if (u1 < mirror) {
                s.wi = {-wo.x, -wo.y, wo.z};
                s.pdf = mirror;
                s.delta = true;
                s.weight = model_.mirror(wo) / mirror;
                return s;
            }
        const float u = (u1 - mirror) / (1.f - mirror);
        if constexpr (requires { model_.sample(wo, u, u2); })
            s.wi = model_.sample(wo, u, u2);
        else
            s.wi = model_.sample(wo, u2);
        if (!(s.wi.z > 0.f)) return std::nullopt;
        s.pdf = model_.pdf(s.wi, wo) * (1.f - mirror);
        if (!(s.pdf > 0.f)) return std::nullopt;
        s.weight = model_.eval(s.wi, wo) * (s.wi.z / s.pdf);
        return s;
    }

  private:
    static constexpr bool has_mirror = requires(const Model& m, Vec3f w) { m.mirror(w); };

    float mirror_probability(const Vec3f& wo) const {
        if constexpr (requires { model_.mirror_probability(wo); })
            return model_.mirror_probability(wo);
        else
            return (void)wo, 0.f;
    }

    Model model_;
};

template <template <class, class, class> class Model>
class EvaluatorOf final : public Evaluator {
    using Double = Model<double, double, double>;
    using Float = Model<float, float, float>;
    using Four = Model<float, Spectral, float>;
    using Bulk = Model<Wide, float, float>;

    static Double make(const ValuesD& v) { return make_model_of<Model, double, double, double>(v); }
    static Float make(const ValuesF& v) { return make_model_of<Model, float, float, float>(v); }
    static Four make(const ValuesS& v) { return make_model_of<Model, float, Spectral, float>(v); }

  public:
    const ModelDescription& description() const override { return Double::describe(); }
    std::vector<std::string> parameter_names() const override {
        std::vector<std::string> names;
        Double model{};
        Double::parameters(model, [&](std::string_view name, auto&) { names.emplace_back(name); });
        return names;
    }

    double eval(const ValuesD& v, const Vec3d& wi, const Vec3d& wo) const override {
        return make(v).eval(wi, wo);
    }
    float eval(const ValuesF& v, const Vec3f& wi, const Vec3f& wo) const override {
        return make(v).eval(wi, wo);
    }
    Spectral eval(const ValuesS& v, const Vec3f& wi, const Vec3f& wo) const override {
        return make(v).eval(wi, wo);
    }
    void eval_many(const ValuesF& v, std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                   std::span<float> out) const override {
        const Bulk model = make_model_of<Model, Wide, float, float>(v);
        constexpr std::size_t n = Wide::size;
        std::size_t i = 0;
        for (; i + n <= out.size(); i += n) {
            const Wide f =
                model.eval(evaluator_detail::load(&wi[i]), evaluator_detail::load(&wo[i]));
            f.store(&out[i]);
        }
        if (i == out.size()) return;
        std::array<Vec3f, n> a, b;
        a.fill({0.f, 0.f, 1.f});
        b.fill({0.f, 0.f, 1.f});
        std::copy(wi.begin() + i, wi.begin() + out.size(), a.begin());
        std::copy(wo.begin() + i, wo.begin() + out.size(), b.begin());
        const Wide f = model.eval(evaluator_detail::load(&a[0]), evaluator_detail::load(&b[0]));
        for (std::size_t k = 0; i < out.size(); ++i, ++k) out[i] = f[int(k)];
    }

    Vec3f sample(const ValuesS& v, const Vec3f& wo, float u1, Vec2f u2) const override {
        const Four model = make(v);
        if constexpr (requires { model.sample(wo, u1, u2); })
            return model.sample(wo, u1, u2);
        else
            return model.sample(wo, u2);
    }
    double pdf(const ValuesD& v, const Vec3d& wi, const Vec3d& wo) const override {
        return make(v).pdf(wi, wo);
    }

    const Bsdf& bind(const ValuesS& v, BsdfScratch& scratch) const override {
        return scratch.make<ModelBsdf<Four>>(make(v));
    }

    bool has_mirror() const override {
        return requires(const Double& m, Vec3d w) { m.mirror(w); };
    }
    Spectral mirror(const ValuesS& v, const Vec3f& wo) const override {
        if constexpr (requires(const Four& m) { m.mirror(wo); })
            return make(v).mirror(wo);
        else
            return (void)v, (void)wo, Spectral(0.f);
    }
    double mirror(const ValuesD& v, const Vec3d& wo) const override {
        if constexpr (requires(const Double& m) { m.mirror(wo); })
            return make(v).mirror(wo);
        else
            return (void)v, (void)wo, 0.;
    }
    std::optional<double> albedo(const ValuesD& v, const Vec3d& wi) const override {
        if constexpr (requires(const Double& m) { m.albedo(wi); })
            return make(v).albedo(wi);
        else
            return (void)v, (void)wi, std::nullopt;
    }
};

template <template <class, class, class> class Model>
const Evaluator& evaluator_of() {
    static const EvaluatorOf<Model> evaluator;
    return evaluator;
}

}  // namespace nacre
