#include "nacre/reflectance/check_random.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "nacre/math/random.h"
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/draw_parameters.h"
#include "nacre/reflectance/model.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;

Vec3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Pairs of directions: random ones, and those at which half vectors, quotients and roots end.
std::vector<std::pair<Vec3d, Vec3d>> pairs(Random& random) {
    std::vector<std::pair<Vec3d, Vec3d>> all;
    const auto somewhere = [&](double least) {
        const double z = least + (0.98 - least) * random.next();
        return direction(std::acos(z), 2. * std::numbers::pi * random.next());
    };
    for (int i = 0; i < 24; ++i) all.emplace_back(somewhere(1e-3), somewhere(1e-3));
    for (double z : {1., 0.5, 1e-2, 1e-4, 1e-8, 1e-20, 0.}) {
        const double s = std::sqrt(1. - z * z);
        const Vec3d w{0.6 * s, 0.8 * s, z};
        for (const Vec3d& v : {w, Vec3d{-w.x, -w.y, z}, Vec3d{-w.x, -w.y, -z}, Vec3d{w.x, w.y, -z},
                               Vec3d{-0.8 * s, 0.6 * s, z}, Vec3d{0., 0., 1.}})
            all.emplace_back(w, v);
    }
    return all;
}

struct Estimate {
    double mean = 0., deviation = 0.;
};
Estimate albedo_by_samples(const AnyModel& model, const Vec3d& wi, Random& random) {
    constexpr int count = 400;
    const ValuesD exact = model.values_double(550.);
    const ValuesS values = model.values(Wavelengths::at(Spectral(550.f)));
    double sum = 0., squares = 0.;
    for (int i = 0; i < count; ++i) {
        const float u1 = (float(i) + 0.5f) / float(count);
        const Vec3d w =
            normalize(Vec3d(model.evaluator().sample(values, Vec3f(wi), u1, random.next2())));
        const double pdf = w.z > 0. ? model.evaluator().pdf(exact, w, wi) : 0.;
        const double f = pdf > 0. ? model.evaluator().eval(exact, wi, w) * w.z / pdf : 0.;
        sum += f;
        squares += f * f;
    }
    const double mean = sum / count;
    return {mean + model.mirror(wi),
            std::sqrt(std::max(0., squares / count - mean * mean) / count)};
}

/// An angle of incidence in degrees, at some azimuth, and the whole albedo there.
struct Looked {
    double angle = 0.;
    Vec3d wi;
    Estimate sampled;
};

std::string text_of(const Vec3d& w) { return fmt::format("{:.9g},{:.9g},{:.9g}", w.x, w.y, w.z); }

/// What is wrong with the values between directions, if anything.
std::optional<std::string> wrong_values(const AnyModel& model, bool reciprocal, Random& random) {
    const Evaluator& evaluator = model.evaluator();
    const ValuesF single = model.values_float(550.f);
    const auto is_value = [](auto x) { return std::isfinite(x) && x >= 0; };
    std::vector<Vec3f> in, out;
    for (const auto& [wi, wo] : pairs(random)) {
        const std::string where = fmt::format("wi {} wo {}", text_of(wi), text_of(wo));
        const double there = model.eval(wi, wo), back = model.eval(wo, wi);
        const double density = model.pdf(wi, wo);
        if (!is_value(there) || !is_value(density))
            return fmt::format("value {} and density {} for {}", there, density, where);
        const double size = std::max(there, back);
        if (reciprocal && size > 1e-12 && !(std::abs(there - back) <= 1e-9 * size))
            return fmt::format("values {:.9g} and {:.9g} of exchanged directions {}", there, back,
                               where);
        in.push_back(Vec3f(wi));
        out.push_back(Vec3f(wo));
        const float f = evaluator.eval(single, in.back(), out.back());
        if (!is_value(f)) return fmt::format("value {} in single precision for {}", f, where);
    }
    std::vector<float> many(in.size());
    evaluator.eval_many(single, in, out, many);
    for (std::size_t i = 0; i < many.size(); ++i)
        if (!is_value(many[i]))
            return fmt::format("value {} in packs for wi {} wo {}", many[i], text_of(Vec3d(in[i])),
                               text_of(Vec3d(out[i])));
    return std::nullopt;
}

/// Whole albedo by quadrature. A coarse one may acquit, but its estimate of its own error can be
/// too small at the rim: what is said to exceed `most`, known to 1e-6 at best, is so by the finest.
Albedo settled_albedo(const AnyModel& model, const Vec3d& wi, double most) {
    Albedo a;
    for (double tolerance : {1e-3, 5e-7}) {
        a = directional_albedo(model, wi, 550., tolerance);
        a.value += model.mirror(wi);
        if (a.value + a.error <= most) break;
    }
    return a;
}

}  // namespace

CheckOutcome check_random_parameters(const Evaluator& evaluator, const Behaviour& behaviour,
                                     const CheckOptions& options) {
    const auto failed = [&](std::string what) { return CheckOutcome{"", false, std::move(what)}; };
    const bool bounded = behaviour.energy == Energy::conserves || behaviour.at_most > 0.;
    // The rounding of tables and sums, as for the examples.
    const double most =
        (behaviour.energy == Energy::conserves ? 1. : behaviour.at_most) * (1. + 1e-6);
    double largest = 0., highest_rank = 0.;
    std::string where;
    NamedNumbers brightest;
    Random random(stream_key(options.seed, 0x52));
    for (int set = 0; set < options.random_sets; ++set) {
        // Every second set changes the brightest so far: a search for what exceeds the claim.
        const NamedNumbers numbers =
            draw_parameters(evaluator.description(), behaviour, random,
                            set % 2 && !brightest.empty() ? &brightest : nullptr);
        const std::string text = settings_text(evaluator.description(), numbers);
        const AnyModel model(evaluator,
                             parse_settings(fmt::format("{} {}", behaviour.options, text)));
        if (const auto wrong = wrong_values(model, behaviour.reciprocal, random))
            return failed(fmt::format("{}, {}", *wrong, text));
        const double grazing = 90. - 10. * std::pow(1e-3, double(random.next()));
        double high = 0., low = infinite;
        Looked brightest_angle;
        const auto note = [&](const Looked& l, double albedo) {
            high = std::max(high, albedo);
            if (!(albedo > largest)) return;
            largest = albedo;
            where = fmt::format("at {:.6g} degrees, {}", l.angle, text);
        };
        for (double angle : {0., 45., 80., 89., 89.9, grazing}) {
            Looked l{angle, direction(angle * degree, 2. * std::numbers::pi * random.next()), {}};
            l.sampled = albedo_by_samples(model, l.wi, random);
            low = std::min(low, l.sampled.mean);
            if (l.sampled.mean > brightest_angle.sampled.mean) brightest_angle = l;
            if (!bounded || !(l.sampled.mean + 4. * l.sampled.deviation > most)) {
                note(l, l.sampled.mean - 3. * l.sampled.deviation);
                continue;
            }
            const Albedo a = settled_albedo(model, l.wi, most);
            note(l, a.value);
            // Where the cells ran out the error is an estimate: the excess must be well above it.
            if (!(a.value - 4. * a.error <= most))
                return failed(fmt::format("albedo {:.6f} {}", a.value, where));
        }
        const Looked& l = brightest_angle;
        if (bounded && l.sampled.mean + l.sampled.deviation > largest)
            note(l, settled_albedo(model, l.wi, most).value);
        // What varies with the angle comes first, or the search would end at a white wall.
        if (const double rank = 2. * high - low; rank > highest_rank) {
            highest_rank = rank;
            brightest = numbers;
        }
    }
    return {"", true,
            fmt::format("{} sets, largest albedo {:.6f} {}", options.random_sets, largest, where)};
}

}  // namespace nacre
