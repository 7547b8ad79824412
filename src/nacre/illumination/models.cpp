#include "nacre/illumination/models.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "nacre/illumination/all_models.h"
#include "nacre/math/error.h"
#include "nacre/math/lanes_math.h"
#include "nacre/text/names.h"

namespace nacre::illumination {

namespace {

constexpr std::size_t count = std::tuple_size_v<AllModels<float>>;
using Indices = std::make_index_sequence<count>;

template <std::size_t... I>
constexpr auto collect(std::index_sequence<I...>) {
    return std::array<const Description*, sizeof...(I)>{
        &std::tuple_element_t<I, AllModels<float>>::description...};
}
constexpr auto all = collect(Indices());

static_assert(
    [] {
        for (std::size_t i = 0; i < count; ++i)
            if (all[i]->number != int(i) + 1 || all[i]->parameters.size() > Values<float>::largest)
                return false;
        return true;
    }(),
    "models stand in the order of their numbers");

/// Calls f with a null pointer to the struct of the model's number.
template <class D, class P, class F, std::size_t... I>
void dispatch(int number, F&& f, std::index_sequence<I...>) {
    (void)((int(I) + 1 == number &&
            (f(static_cast<std::tuple_element_t<I, AllModels<D, P>>*>(nullptr)), true)) ||
           ...);
}

std::string describe(const Description& model) {
    return fmt::format("illumination model {} ({})", model.number, model.name);
}

}  // namespace

std::span<const Description* const> descriptions() { return all; }

const Description& find_model(std::string_view name) {
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc() && end == name.data() + name.size()) {
        if (number < 1 || number > int(count))
            throw InputError(
                fmt::format("illumination models are numbered 1 to {}; got {}", count, number));
        return *all[std::size_t(number) - 1];
    }
    std::vector<std::string_view> names;
    for (const Description* d : all) names.push_back(d->name);
    const int i = find_name(name, names);
    if (i < 0) throw InputError(unknown_name("illumination model", name, names));
    return *all[std::size_t(i)];
}

std::string range_text(const Parameter& p) {
    if (p.kind == Parameter::Kind::choice)
        return fmt::format("one of {}", fmt::join(p.choices, ", "));
    if (p.high == unlimited)
        return p.low_excluded ? fmt::format("greater than {}", p.low)
                              : fmt::format("at least {}", p.low);
    return fmt::format("within {}{}, {}{}", p.low_excluded ? '(' : '[', p.low, p.high,
                       p.high_excluded ? ')' : ']');
}

void check_value(const Description& model, const Parameter& p, double value) {
    const bool low = p.low_excluded ? value > p.low : value >= p.low;
    const bool high = p.high_excluded ? value < p.high : value <= p.high;
    if (!low || !high || !std::isfinite(value))
        throw InputError(fmt::format("'{}' of {} must be {}; got {}", p.name, describe(model),
                                     range_text(p), value));
}

int find_choice(const Description& model, const Parameter& p, std::string_view word) {
    const int i = find_name(word, p.choices);
    if (i < 0)
        throw InputError(fmt::format("'{}' of {} must be {}; got '{}'", p.name, describe(model),
                                     range_text(p), word));
    return i;
}

template <class D, class P>
Product<D, P> intensity(const Description& model, const Values<D, P>& values,
                        const Lighting<D, P>& at) {
    Product<D, P> result(0.f);
    dispatch<D, P>(
        model.number,
        [&]<class Model>(Model*) {
            if constexpr (requires(Model m) { m.intensity(at); })
                result = Model::from(values).intensity(at);
            else
                throw std::logic_error("transparency models have no intensity");
        },
        Indices());
    return result;
}

template <class D, class P>
Product<D, P> transmittance(const Description& model, const Values<D, P>& values,
                            const Vec3<D>& wo) {
    Product<D, P> result(0.f);
    dispatch<D, P>(
        model.number,
        [&]<class Model>(Model*) {
            if constexpr (requires(Model m) { m.transmittance(wo); })
                result = Model::from(values).transmittance(wo);
            else
                throw std::logic_error("only transparency models have a transmittance");
        },
        Indices());
    return result;
}

template Spectral intensity(const Description&, const Values<float, Spectral>&,
                            const Lighting<float, Spectral>&);
template float intensity(const Description&, const Values<float>&, const Lighting<float>&);
template double intensity(const Description&, const Values<double>&, const Lighting<double>&);
template Spectral transmittance(const Description&, const Values<float, Spectral>&, const Vec3f&);
template float transmittance(const Description&, const Values<float>&, const Vec3f&);
template double transmittance(const Description&, const Values<double>&, const Vec3d&);

}  // namespace nacre::illumination
