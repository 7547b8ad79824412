// Materials bound to a point: what they are asked together is what they are asked one by one, and
// where they are bound makes no difference.
#include <cstring>

#include "nacre/math/random.h"
#include "nacre/reflectance/registry.h"
#include "tests/scene/material_fixture.h"

namespace nacre {
namespace {

using test::bsdf;
using test::child;
using test::node;
using test::number;
using test::rgb;
using test::text;

/// A model's own examples as a scene would write them.
std::shared_ptr<SceneNode> model_node(const ModelDescription& model, const std::string& settings) {
    const auto made = bsdf(std::string(model.name));
    for (const Setting& s : parse_settings(settings)) {
        const int position = find_parameters(model.name, model.parameters, s.name).front();
        if (model.parameters[std::size_t(position)].kind == ParameterKind::integer)
            made->values.push_back(
                {s.name, "integer", std::int64_t(std::get<double>(s.value)), test::at(2, 5)});
        else if (const double* value = std::get_if<double>(&s.value))
            made->values.push_back(number(s.name, *value));
        else if (const std::string* word = std::get_if<std::string>(&s.value))
            made->values.push_back(text(s.name, *word));
        else
            made->values.push_back(rgb(s.name, std::get<Vec3f>(s.value)));
    }
    return made;
}

/// Every type of material and every behaviour of every model.
std::vector<test::NamedMaterial> everything() {
    auto list = test::all_materials();
    for (const ModelDescription* m : models())
        for (const Behaviour& b : m->behaviours)
            for (const std::string_view example : b.examples) {
                const std::string settings = fmt::format("{} {}", b.options, example);
                list.push_back({fmt::format("{} {}", m->name, settings),
                                test::material(model_node(*m, settings)), false});
            }
    return list;
}

const Wavelengths modes[] = {Wavelengths::rgb_bands(),
                             Wavelengths::at(Spectral(450.f, 530.f, 590.f, 670.f))};

Vec3f random_direction(Random& random, bool both_sides) {
    const float z = (both_sides ? 2.f : 1.f) * (random.next() - (both_sides ? 0.5f : 0.f));
    const float r = std::sqrt(1.f - z * z), phi = 6.2831853f * random.next();
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// What a BSDF says to given questions, bit by bit.
std::vector<float> answers(const Bsdf& bsdf) {
    Random random(stream_key(5, 6));
    std::vector<float> list;
    const auto add = [&](const Spectral& s) {
        for (int i = 0; i < 4; ++i) list.push_back(s[i]);
    };
    for (int i = 0; i < 20; ++i) {
        const Vec3f wo = random_direction(random, true), wi = random_direction(random, true);
        const float u1 = random.next();
        const auto s = bsdf.sample(wo, u1, random.next2());
        add(bsdf.eval(wi, wo));
        list.push_back(bsdf.pdf(wi, wo));
        add(bsdf.null_transmission(wo));
        if (!s) continue;
        add(s->weight);
        list.insert(list.end(), {s->wi.x, s->wi.y, s->wi.z, s->pdf, s->eta});
    }
    return list;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

const SurfacePoint here{.p = {0.1f, 0.2f, 0.3f},
                        .ng = {0.f, 0.f, 1.f},
                        .shading = Framef::around({0.f, 0.f, 1.f}),
                        .uv = {0.3f, 0.6f}};

/// `count` masks of opacity 0.99 around a matt surface.
SceneNodePtr onion(int count) {
    SceneNodePtr inner = bsdf("diffuse", {number("reflectance", 0.8)});
    for (int i = 0; i < count; ++i) inner = bsdf("mask", {number("opacity", 0.99)}, {child(inner)});
    return inner;
}

}  // namespace

TEST(Bsdf, TogetherIsOneByOne) {
    for (const auto& m : everything())
        for (const Wavelengths& w : modes) {
            const test::Bound bsdf(m.material, here, w);
            Random random(stream_key(11, 2));
            for (int i = 0; i < 200; ++i) {
                const Vec3f wo = random_direction(random, m.two_sides),
                            wi = random_direction(random, m.two_sides);
                const BsdfValue both = bsdf->eval_pdf(wi, wo);
                const Spectral f = bsdf->eval(wi, wo);
                const float pdf = bsdf->pdf(wi, wo);
                // Fused operations may differ in the last place.
                ASSERT_NEAR(both.pdf, pdf, 2e-6f * pdf) << m.name;
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(both.f[c], f[c], 2e-6f * f[c]) << m.name;
            }
        }
}

TEST(Bsdf, SamplesWeighValueOverDensity) {
    for (const auto& m : everything())
        for (const Wavelengths& w : modes) {
            const test::Bound bsdf(m.material, here, w);
            Random random(stream_key(12, 3));
            for (int i = 0; i < 200; ++i) {
                const Vec3f wo = random_direction(random, m.two_sides);
                const float u1 = random.next();
                const auto s = bsdf->sample(wo, u1, random.next2());
                if (!s || s->delta) continue;
                const BsdfValue value = bsdf->eval_pdf(s->wi, wo);
                ASSERT_NEAR(s->pdf, value.pdf, 1e-3f * value.pdf) << m.name;
                for (int c = 0; c < (s->single_wavelength ? 1 : 3); ++c)
                    ASSERT_NEAR(s->weight[c] * value.pdf, value.f[c], 1e-3f * value.f[c] + 1e-6f)
                        << m.name;
            }
        }
}

TEST(Bsdf, TheScratchMakesNoDifference) {
    const auto list = everything();
    BsdfScratch reused;
    for (const Wavelengths& w : modes)
        for (const auto& m : list) {
            reused.reset();
            // Something else lies where it would lie in a fresh one.
            list.front().material->at(here, w, reused);
            const std::vector<float> second = answers(m.material->at(here, w, reused));
            BsdfScratch fresh;
            const std::vector<float> first = answers(m.material->at(here, w, fresh));
            EXPECT_TRUE(same_bits(first, second)) << m.name;
        }
}

TEST(Bsdf, OfOneModelEverywhereIsBoundOnceInBands) {
    const auto squares = node("texture", "checkerboard", {number("color0", 0.1)});
    const MaterialPtr even = test::material(bsdf("ward")),
                      uneven = test::material(bsdf("ward", {}, {child(squares, "ks")}));
    SurfacePoint elsewhere = here;
    elsewhere.uv = {0.8f, 0.6f};
    BsdfScratch scratch;
    const auto at = [&](const MaterialPtr& m, const SurfacePoint& p, const Wavelengths& w) {
        return &m->at(p, w, scratch);
    };
    EXPECT_EQ(at(even, here, modes[0]), at(even, elsewhere, modes[0]));
    EXPECT_NE(at(even, here, modes[1]), at(even, here, modes[1]));
    EXPECT_NE(at(uneven, here, modes[0]), at(uneven, elsewhere, modes[0]));
    const Vec3f up{0.f, 0.f, 1.f};
    EXPECT_NE(at(uneven, here, modes[0])->eval(up, up)[0],
              at(uneven, elsewhere, modes[0])->eval(up, up)[0]);
}

// Every mask takes some hundred bytes: a thousand of them do not fit the stack.
TEST(Bsdf, NestsAsDeepAsTheScene) {
    const Vec3f wi{0.48f, 0.36f, 0.8f}, wo{-0.6f, 0.f, 0.8f};
    BsdfScratch scratch;
    for (const int depth : {0, 1, 30, 1000}) {
        scratch.reset();
        const MaterialPtr m = test::material(onion(depth));
        const Bsdf& bound = m->at(here, modes[0], scratch);
        const double opacity = std::pow(double(0.99f), depth);
        EXPECT_NEAR(bound.eval(wi, wo)[1], opacity * 0.8 / M_PI * 0.8, 1e-4 * opacity) << depth;
        EXPECT_NEAR(bound.eval_pdf(wi, wo).pdf, opacity / M_PI * 0.8, 1e-4 * opacity) << depth;
        EXPECT_NEAR(bound.null_transmission(wo)[1], 1. - opacity, 1e-4) << depth;
        BsdfScratch fresh;
        EXPECT_TRUE(same_bits(answers(bound), answers(m->at(here, modes[0], fresh)))) << depth;
    }
}

TEST(BsdfScratch, GivesEachThingItsOwnAlignedPlace) {
    struct alignas(32) Wide {
        float v[8];
    };
    struct Small {
        char c;
    };
    struct Big {
        char bytes[3 * BsdfScratch::inline_size];
    };
    BsdfScratch scratch;
    for (int round = 0; round < 3; ++round, scratch.reset()) {
        std::vector<std::pair<std::uintptr_t, std::size_t>> places;
        for (int i = 0; i < 400; ++i) {
            places.emplace_back(std::uintptr_t(&scratch.make<Small>()), sizeof(Small));
            const Wide& wide = scratch.make<Wide>();
            EXPECT_EQ(std::uintptr_t(&wide) % alignof(Wide), 0u);
            places.emplace_back(std::uintptr_t(&wide), sizeof(Wide));
            if (i % 100 == 0)
                places.emplace_back(std::uintptr_t(&scratch.make<Big>()), sizeof(Big));
        }
        std::sort(places.begin(), places.end());
        for (std::size_t i = 1; i < places.size(); ++i)
            ASSERT_LE(places[i - 1].first + places[i - 1].second, places[i].first);
    }
}

}  // namespace nacre
