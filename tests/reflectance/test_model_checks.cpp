// Every model of the list against its own claims; and that the checks find models that lie.
#include "nacre/reflectance/check.h"
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/lambert.h"
#include "nacre/reflectance/registry.h"

namespace nacre {
namespace {

class EveryModel : public testing::TestWithParam<const ModelDescription*> {};

/// A Lambert surface that is told what to say and do wrong.
enum class Lie { none, reciprocal, energy, density, sampler, horizon, albedo, modest };
template <Lie lie>
const ModelDescription& lying_description() {
    static const ModelDescription description = [] {
        ModelDescription d = lambert_description();
        d.name = "liar";
        if (lie == Lie::modest) d.behaviours[0].reciprocal = false;
        return d;
    }();
    return description;
}

template <Lie lie, class D, class P, class S>
struct Lying {
    P reflectance;

    static const ModelDescription& describe() { return lying_description<lie>(); }
    template <class Self, class F>
    static void parameters(Self& m, F&& f) {
        f("reflectance", m.reflectance);
    }
    Product<D, P> eval(const Vec3<D>& wi, const Vec3<D>& wo) const {
        D f = D(inv_pi);
        if (lie == Lie::reciprocal) f = f * (D(0.9) + D(0.1) * wi.z);
        if (lie == Lie::energy) f = f * D(1.3);
        return (lie == Lie::horizon ? f : above(wi, wo) * f) * reflectance;
    }
    Vec3<D> sample(const Vec3<D>&, Vec2<D> u) const {
        if (lie == Lie::sampler) u.x = u.x * u.x;
        return square_to_cosine_hemisphere(u);
    }
    D pdf(const Vec3<D>& wi, const Vec3<D>& wo) const {
        return above(wi, wo) * D(inv_pi) * wi.z * D(lie == Lie::density ? 0.95 : 1.);
    }
    P albedo(const Vec3<D>&) const { return reflectance * P(lie == Lie::albedo ? 0.9 : 1.); }
};
template <class D, class P, class S>
struct Honest : Lying<Lie::none, D, P, S> {};
template <class D, class P, class S>
struct NotReciprocal : Lying<Lie::reciprocal, D, P, S> {};
template <class D, class P, class S>
struct MakesEnergy : Lying<Lie::energy, D, P, S> {};
template <class D, class P, class S>
struct WrongDensity : Lying<Lie::density, D, P, S> {};
template <class D, class P, class S>
struct WrongSampler : Lying<Lie::sampler, D, P, S> {};
template <class D, class P, class S>
struct ShinesThrough : Lying<Lie::horizon, D, P, S> {};
template <class D, class P, class S>
struct WrongAlbedo : Lying<Lie::albedo, D, P, S> {};
template <class D, class P, class S>
struct Modest : Lying<Lie::modest, D, P, S> {};

/// The checks that fail, "reciprocity albedo".
template <template <class, class, class> class Model>
std::string failures() {
    std::string failed;
    CheckOptions options;
    options.random_sets = 0;
    for (const CheckOutcome& c : check_model(EvaluatorOf<Model>(), options))
        if (!c.passed) failed += (failed.empty() ? "" : " ") + c.name.substr(c.name.find(": ") + 2);
    return failed;
}

}  // namespace

TEST_P(EveryModel, PassesItsChecks) {
    CheckOptions options;
    options.random_sets = 0;  // test_random_claims.cpp
    for (const CheckOutcome& c : check_model(find_evaluator(GetParam()->name), options))
        EXPECT_TRUE(c.passed) << c.name << ": " << c.detail;
}

TEST_P(EveryModel, HasACompleteDescription) {
    const ModelDescription& m = *GetParam();
    EXPECT_FALSE(m.title.empty() || m.authors.empty() || m.paper.empty() || m.formula.empty());
    EXPECT_FALSE(m.sampling.empty());
    EXPECT_GE(m.year, 1760);
    EXPECT_FALSE(m.references.empty());
    EXPECT_FALSE(m.behaviours.empty());
    EXPECT_LE(m.parameters.size(), std::size_t(max_parameters));
    for (const Parameter& p : m.parameters) {
        EXPECT_FALSE(p.meaning.empty()) << p.name;
        EXPECT_NO_THROW(check_range(m.name, p, p.otherwise)) << p.name;
        EXPECT_EQ(p.kind == ParameterKind::choice, !p.choices.empty()) << p.name;
        if (p.kind == ParameterKind::choice) {
            EXPECT_EQ(p.high, double(p.choices.size()) - 1.) << p.name;
        }
    }
    for (const Behaviour& b : m.behaviours) {
        EXPECT_FALSE(b.examples.empty());
        EXPECT_EQ(b.energy == Energy::exceeds, !b.witness.empty()) << b.options;
    }
}

INSTANTIATE_TEST_SUITE_P(Canon, EveryModel, testing::ValuesIn(models()),
                         [](const auto& info) { return std::string(info.param->name); });

TEST(ModelChecks, FindModelsThatLie) {
    EXPECT_EQ(failures<Honest>(), "");
    EXPECT_EQ(failures<NotReciprocal>(), "reciprocity albedo");
    EXPECT_EQ(failures<MakesEnergy>(), "furnace albedo");
    EXPECT_EQ(failures<WrongDensity>(), "sampling");
    EXPECT_EQ(failures<WrongSampler>(), "sampling");
    EXPECT_EQ(failures<ShinesThrough>(), "horizon");
    EXPECT_EQ(failures<WrongAlbedo>(), "albedo");
    EXPECT_EQ(failures<Modest>(), "reciprocity");
}

}  // namespace nacre
