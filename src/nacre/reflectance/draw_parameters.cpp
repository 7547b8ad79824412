#include "nacre/reflectance/draw_parameters.h"

#include <algorithm>
#include <cmath>

#include "nacre/reflectance/registry.h"

namespace nacre {
namespace {

const Condition* condition_of(const Behaviour& b, std::string_view name) {
    for (const Condition& c : b.conditions)
        if (c.parameter == name) return &c;
    return nullptr;
}

double drawn(double low, double high, bool above_low, Random& random) {
    // Wider ranges are spanned by 1e4 and, now and then, their end.
    const double end = std::min(high, 1e4);
    const double u = random.next(), v = random.next();
    if (u < 0.1) return above_low ? low + 1e-3 * (end - low) : low;
    if (u < 0.2) return v < 0.5 ? high : end;
    if (u < 0.6) {
        // In logarithms, from the low end.
        const double least = low > 0. ? low : 1e-3 * end;
        if (low >= 0. && least < end) return least * std::pow(end / least, v);
    }
    return low + (end - low) * std::max(v, 1e-4);
}

double drawn_choice(const ModelDescription& model, const Parameter& p, const Condition* condition,
                    Random& random) {
    const auto any_of = [&](std::size_t n) {
        return std::min(std::size_t(random.next() * float(n)), n - 1);
    };
    if (condition && !condition->choices.empty())
        return find_choice(model.name, p, condition->choices[any_of(condition->choices.size())]);
    return double(any_of(p.choices.size()));
}

/// With a parent's number: a number near it, as often as a new one.
double drawn_number(const Parameter& p, const Condition* condition, const double* parent,
                    Random& random) {
    const double low = condition ? std::max(p.low, condition->low) : p.low;
    const double high = condition ? std::min(p.high, condition->high) : p.high;
    // Colours as often at an end as not: much is at stake where all is reflected by one part.
    const double corner = random.next();
    double value = drawn(low, high, p.above_low && low == p.low, random);
    if (p.kind == ParameterKind::spectrum && p.high <= 1. && corner < 0.6f)
        value = corner < 0.25f ? low : high;
    if (parent && random.next() < 0.5f)
        value = std::clamp(*parent * std::exp(double(random.next()) - 0.5), low, high);
    return p.kind == ParameterKind::integer ? std::round(value) : value;
}

double* find(NamedNumbers& numbers, std::string_view name) {
    for (auto& n : numbers)
        if (n.first == name) return &n.second;
    return nullptr;
}

void bring_sums_within(const ModelDescription& model, NamedNumbers& numbers) {
    for (const SumBound& bound : model.bounds) {
        std::vector<double*> parts;
        for (std::string_view name : bound.parameters)
            if (double* n = find(numbers, name)) parts.push_back(n);
        double sum = 0.;
        for (const double* n : parts) sum += *n;
        if (sum > 1.)
            for (double* n : parts) *n /= sum * (1. + 1e-12);
    }
}

}  // namespace

NamedNumbers draw_parameters(const ModelDescription& model, const Behaviour& behaviour,
                             Random& random, const NamedNumbers* parent) {
    const Settings fixed = parse_settings(behaviour.options);
    NamedNumbers numbers;
    for (const Parameter& p : model.parameters) {
        const bool set = std::any_of(fixed.begin(), fixed.end(),
                                     [&](const Setting& s) { return s.name == p.name; });
        if (set || p.kind == ParameterKind::wavelength) continue;
        const Condition* c = condition_of(behaviour, p.name);
        const double* old = parent ? &(*parent)[numbers.size()].second : nullptr;
        double value = p.kind == ParameterKind::choice ? drawn_choice(model, p, c, random)
                                                       : drawn_number(p, c, old, random);
        if (old && random.next() < 0.6f) value = *old;
        if (c && !c->same_as.empty())
            if (const double* other = find(numbers, c->same_as)) value = *other;
        numbers.emplace_back(p.name, value);
    }
    bring_sums_within(model, numbers);
    if (behaviour.joint.bring_within) behaviour.joint.bring_within(numbers);
    return numbers;
}

std::string settings_text(const ModelDescription& model, const NamedNumbers& numbers) {
    std::string text;
    for (const auto& [name, value] : numbers) {
        const Parameter& p =
            model.parameters[find_parameters(model.name, model.parameters, name).front()];
        if (!text.empty()) text += ' ';
        text += p.kind == ParameterKind::choice
                    ? fmt::format("{}={}", name, p.choices[std::size_t(value)].name)
                    : fmt::format("{}={:.17g}", name, value);
    }
    return text;
}

}  // namespace nacre
