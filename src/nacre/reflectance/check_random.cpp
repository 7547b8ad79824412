#include "nacre/reflectance/check_random.h"

#include <algorithm>
#include <cmath>

#include "nacre/math/random.h"
#include "nacre/reflectance/albedo.h"
#include "nacre/reflectance/model.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.;

Vec3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

const Condition* condition_of(const Behaviour& b, std::string_view name) {
    for (const Condition& c : b.conditions)
        if (c.parameter == name) return &c;
    return nullptr;
}

double drawn(double low, double high, bool above_low, Random& random) {
    high = std::min(high, 1e4);
    const double u = random.next(), v = random.next();
    if (u < 0.1) return above_low ? low + 1e-3 * (high - low) : low;
    if (u < 0.2) return high;
    if (u < 0.6) {
        // In logarithms, from the low end.
        const double least = low > 0. ? low : 1e-3 * high;
        if (low >= 0. && least < high) return least * std::pow(high / least, v);
    }
    return low + (high - low) * std::max(v, 1e-4);
}

/// Parameters as text, without those that the behaviour's options set.
std::string draw_settings(const ModelDescription& model, const Behaviour& behaviour,
                          Random& random) {
    const Settings fixed = parse_settings(behaviour.options);
    std::vector<std::pair<std::string_view, double>> numbers;
    std::string text;
    const auto is_fixed = [&](std::string_view name) {
        return std::any_of(fixed.begin(), fixed.end(),
                           [&](const Setting& s) { return s.name == name; });
    };
    for (const Parameter& p : model.parameters) {
        if (is_fixed(p.name) || p.kind == ParameterKind::wavelength) continue;
        if (p.kind == ParameterKind::choice) {
            const Condition* c = condition_of(behaviour, p.name);
            const std::size_t last = c ? std::size_t(c->high) : p.choices.size() - 1;
            const std::size_t i = std::min(std::size_t(random.next() * float(last + 1)), last);
            text += fmt::format("{}={} ", p.name, p.choices[i].name);
            continue;
        }
        const Condition* c = condition_of(behaviour, p.name);
        const bool ranged = c && c->same_as.empty();
        double value = drawn(ranged ? std::max(p.low, c->low) : p.low,
                             ranged ? std::min(p.high, c->high) : p.high,
                             p.above_low && !(ranged && c->low > p.low), random);
        if (c && !c->same_as.empty())
            for (const auto& [name, number] : numbers)
                if (name == c->same_as) value = number;
        if (p.kind == ParameterKind::integer) value = std::round(value);
        numbers.emplace_back(p.name, value);
    }
    for (const SumBound& bound : model.bounds) {
        const auto within = [&](const auto& n) {
            return std::find(bound.parameters.begin(), bound.parameters.end(), n.first) !=
                   bound.parameters.end();
        };
        double sum = 0.;
        for (const auto& n : numbers)
            if (within(n)) sum += n.second;
        for (auto& n : numbers)
            if (within(n) && sum > 1.) n.second /= sum * (1. + 1e-12);
    }
    for (const auto& [name, value] : numbers) text += fmt::format("{}={:.17g} ", name, value);
    if (!text.empty()) text.pop_back();
    return text;
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
    double mean, deviation;
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
    return {mean, std::sqrt(std::max(0., squares / count - mean * mean) / count)};
}

}  // namespace

CheckOutcome check_random_parameters(const Evaluator& evaluator, const Behaviour& behaviour,
                                     const CheckOptions& options) {
    constexpr double angles[] = {0., 45., 80., 89., 89.9};
    const ModelDescription& description = evaluator.description();
    CheckOutcome outcome{"", true, ""};
    const auto fail = [&](std::string what) {
        if (outcome.passed) outcome.detail = std::move(what);
        outcome.passed = false;
    };
    const bool bounded = behaviour.energy == Energy::conserves || behaviour.at_most > 0.;
    const double most = behaviour.energy == Energy::conserves ? 1. : behaviour.at_most;
    double largest = 0.;
    std::string where;
    Random random(stream_key(options.seed, 0x52));
    for (int set = 0; set < options.random_sets && outcome.passed; ++set) {
        const std::string text = draw_settings(description, behaviour, random);
        const AnyModel model(evaluator,
                             parse_settings(fmt::format("{} {}", behaviour.options, text)));
        const ValuesF single = model.values_float(550.f);
        std::vector<Vec3f> in, out;
        for (const auto& [wi, wo] : pairs(random)) {
            const double there = model.eval(wi, wo), back = model.eval(wo, wi);
            const double density = model.pdf(wi, wo);
            if (!(std::isfinite(there) && there >= 0. && std::isfinite(density) && density >= 0.))
                fail(
                    fmt::format("value {} and density {} for wi {:.9g},{:.9g},{:.9g} wo "
                                "{:.9g},{:.9g},{:.9g}, {}",
                                there, density, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z, text));
            const double size = std::max(std::abs(there), std::abs(back));
            if (behaviour.reciprocal && size > 1e-12 && std::min(wi.z, wo.z) > 1e-6 &&
                !(std::abs(there - back) <= 1e-6 * size))
                fail(
                    fmt::format("values {:.9g} and {:.9g} of exchanged directions wi "
                                "{:.9g},{:.9g},{:.9g} wo {:.9g},{:.9g},{:.9g}, {}",
                                there, back, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z, text));
            in.push_back(Vec3f(wi));
            out.push_back(Vec3f(wo));
            const float f = evaluator.eval(single, in.back(), out.back());
            if (!(std::isfinite(f) && f >= 0.f))
                fail(
                    fmt::format("value {} in single precision for wi {:.9g},{:.9g},{:.9g} wo "
                                "{:.9g},{:.9g},{:.9g}, {}",
                                f, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z, text));
        }
        std::vector<float> many(in.size());
        evaluator.eval_many(single, in, out, many);
        for (std::size_t i = 0; i < many.size(); ++i)
            if (!(std::isfinite(many[i]) && many[i] >= 0.f))
                fail(fmt::format("value {} in packs, pair {}, {}", many[i], i, text));
        for (double angle : angles) {
            const Vec3d wi = direction(angle * degree, 0.4 + random.next());
            const double mirror = model.mirror(wi);
            const Estimate e = albedo_by_samples(model, wi, random);
            double albedo = e.mean - 3. * e.deviation + mirror, error = 0.;
            if (bounded && (set < 4 || e.mean + 3. * e.deviation + mirror > most)) {
                const Albedo a = directional_albedo(model, wi, 550., 1e-5);
                albedo = a.value + mirror;
                error = a.error;
            }
            if (albedo > largest) {
                largest = albedo;
                where = fmt::format("at {} degrees, {}", angle, text);
            }
            if (bounded && !(albedo <= most + 2e-3 + error))
                fail(fmt::format("albedo {:.6f} {}", albedo, where));
        }
    }
    if (outcome.passed)
        outcome.detail =
            fmt::format("{} sets, largest albedo {:.6f} {}", options.random_sets, largest, where);
    return outcome;
}

}  // namespace nacre
