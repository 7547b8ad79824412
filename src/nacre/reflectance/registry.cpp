#include "nacre/reflectance/registry.h"

#include <charconv>

#include "nacre/math/error.h"
#include "nacre/optics/names.h"
#include "nacre/reflectance/models.h"

namespace nacre {
namespace {

const std::vector<const Evaluator*>& evaluators() {
#define NACRE_LIST_MODEL(Model) &evaluator_of<Model>(),
    static const std::vector<const Evaluator*> all{NACRE_MODELS(NACRE_LIST_MODEL)};
#undef NACRE_LIST_MODEL
    return all;
}

double parse_number(std::string_view text, std::string_view whole) {
    double value = 0.;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw InputError(fmt::format("'{}' in '{}' is not a number", text, whole));
    return value;
}

bool starts_a_number(std::string_view text) {
    double value = 0.;
    return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
}

}  // namespace

const std::vector<const ModelDescription*>& models() {
    static const std::vector<const ModelDescription*> all = [] {
        std::vector<const ModelDescription*> r;
        for (const Evaluator* e : evaluators()) r.push_back(&e->description());
        return r;
    }();
    return all;
}

const Evaluator& find_evaluator(std::string_view name) {
    std::vector<std::string_view> names;
    for (const ModelDescription* m : models()) names.push_back(m->name);
    const int i = find_name(name, names);
    if (i < 0) throw InputError(unknown_name("reflectance model", name, names));
    return *evaluators()[i];
}

Setting parse_setting(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0 || equals + 1 == text.size())
        throw InputError(fmt::format(
            "'{}' does not set a parameter; write name=value, such as alpha=0.2", text));
    Setting setting{std::string(text.substr(0, equals)), 0.};
    const std::string_view value = text.substr(equals + 1);
    const std::size_t comma = value.find(',');
    if (comma != value.npos) {
        const std::size_t second = value.find(',', comma + 1);
        if (second == value.npos || value.find(',', second + 1) != value.npos)
            throw InputError(
                fmt::format("'{}' must have one number or three (red,green,blue)", text));
        Vec3f rgb{float(parse_number(value.substr(0, comma), text)),
                  float(parse_number(value.substr(comma + 1, second - comma - 1), text)),
                  float(parse_number(value.substr(second + 1), text))};
        setting.value = rgb;
    } else if (starts_a_number(value)) {
        setting.value = parse_number(value, text);
    } else {
        setting.value = std::string(value);
    }
    return setting;
}

Settings parse_settings(std::string_view text) {
    Settings settings;
    while (true) {
        const std::size_t begin = text.find_first_not_of(' ');
        if (begin == text.npos) return settings;
        text.remove_prefix(begin);
        const std::size_t end = std::min(text.find(' '), text.size());
        settings.push_back(parse_setting(text.substr(0, end)));
        text.remove_prefix(end);
    }
}

std::vector<int> find_parameters(const ModelDescription& model, std::string_view name) {
    std::vector<int> found;
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
        const Parameter& p = model.parameters[i];
        names.push_back(p.name);
        if (p.name == name) return {int(i)};
        if (std::find(p.aliases.begin(), p.aliases.end(), name) != p.aliases.end())
            found.push_back(int(i));
    }
    if (found.empty())
        throw InputError(fmt::format("{}: {}", model.name, unknown_name("parameter", name, names)));
    return found;
}

int find_choice(const ModelDescription& model, const Parameter& parameter, std::string_view word) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
        const Choice& c = parameter.choices[i];
        names.push_back(c.name);
        if (c.name == word ||
            std::find(c.aliases.begin(), c.aliases.end(), word) != c.aliases.end())
            return int(i);
    }
    throw InputError(fmt::format("{}: {}", model.name,
                                 unknown_name(fmt::format("{}", parameter.name), word, names)));
}

std::string range_text(const Parameter& p) {
    return fmt::format("{}{}, {}{}", p.above_low ? '(' : '[', p.low, p.high,
                       p.high == infinite ? ')' : ']');
}

void check_range(const ModelDescription& model, const Parameter& p, double value) {
    const bool inside =
        std::isfinite(value) && value <= p.high && (p.above_low ? value > p.low : value >= p.low);
    if (!inside)
        throw InputError(fmt::format("{}: {} = {} is out of range: must lie within {}", model.name,
                                     p.name, value, range_text(p)));
    if (p.kind == ParameterKind::integer && value != std::floor(value))
        throw InputError(
            fmt::format("{}: {} = {} must be a whole number", model.name, p.name, value));
}

AnyModel::AnyModel(const Evaluator& evaluator, const Settings& settings, Bounds bounds)
    : evaluator_(&evaluator) {
    const ModelDescription& model = description();
    std::vector<std::string> given(model.parameters.size());
    for (const Parameter& p : model.parameters) values_.push_back({p.otherwise, nullptr});
    for (const Setting& s : settings)
        for (int i : find_parameters(model, s.name)) {
            const Parameter& p = model.parameters[i];
            if (!given[i].empty())
                throw InputError(fmt::format("{}: {} is given twice, as '{}' and '{}'", model.name,
                                             p.name, given[i], s.name));
            given[i] = s.name;
            Value& v = values_[i];
            if (const auto* word = std::get_if<std::string>(&s.value)) {
                if (p.kind != ParameterKind::choice)
                    throw InputError(fmt::format("{}: {} = '{}' must be a number within {}",
                                                 model.name, p.name, *word, range_text(p)));
                v.number = find_choice(model, p, *word);
            } else if (p.kind == ParameterKind::choice) {
                const auto* number = std::get_if<double>(&s.value);
                v.number = find_choice(model, p, number ? fmt::format("{}", *number) : "a colour");
            } else if (const auto* number = std::get_if<double>(&s.value)) {
                check_range(model, p, *number);
                v.number = *number;
            } else {
                if (p.kind != ParameterKind::spectrum)
                    throw InputError(fmt::format("{}: {} is one number, not a colour or spectrum",
                                                 model.name, p.name));
                if (const auto* rgb = std::get_if<Vec3f>(&s.value)) {
                    for (int c = 0; c < 3; ++c) check_range(model, p, (*rgb)[c]);
                    v.spectrum =
                        p.high <= 1. ? make_rgb_reflectance(*rgb) : make_rgb_unbounded(*rgb);
                } else {
                    v.spectrum = std::get<SpectrumPtr>(s.value);
                    check_range(model, p, v.spectrum->max());
                }
            }
        }
    if (bounds == Bounds::enforced) check_bounds();
}

void AnyModel::check_bounds() const {
    for (const SumBound& b : description().bounds) {
        std::vector<int> positions;
        for (std::string_view name : b.parameters)
            positions.push_back(find_parameters(description(), name).front());
        const bool spectral = std::any_of(positions.begin(), positions.end(), [&](int i) {
            return values_[i].spectrum && values_[i].spectrum->is_spectral();
        });
        const auto sum_at = [&](const Wavelengths& w) {
            const ValuesS v = values(w);
            Spectral sum(0.f);
            for (int i : positions) sum += v.color[i];
            return max_lane(sum);
        };
        check_sum(description(), b, largest_over_wavelengths(sum_at, spectral));
    }
}

float largest_over_wavelengths(const std::function<float(const Wavelengths&)>& f, bool spectral) {
    float largest = f(Wavelengths::rgb_bands());
    if (!spectral) return largest;
    for (float nm = visible_min; nm <= visible_max; nm += 20.f)
        largest =
            std::max(largest, f(Wavelengths::at(Spectral(nm, nm + 5.f, nm + 10.f, nm + 15.f))));
    return largest;
}

void check_sum(const ModelDescription& model, const SumBound& bound, double sum) {
    // Uplifted colours may exceed what was written by rounding.
    if (sum <= 1. + 1e-4) return;
    std::string names;
    for (std::string_view name : bound.parameters)
        names += fmt::format("{}{}", names.empty() ? "" : " + ", name);
    throw InputError(
        fmt::format("{}: {} = {:.6g} is out of range: must lie within [0, 1], lest "
                    "energy appear from nowhere",
                    model.name, names, sum));
}

Spectral band_wavelengths() { return Spectral(611.4f, 549.1f, 464.2f, 549.1f); }

Wavelengths AnyModel::at(float nm) { return Wavelengths::at(Spectral(nm)); }

ValuesS AnyModel::values(const Wavelengths& w) const {
    ValuesS r;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Value& v = values_[i];
        const ParameterKind kind = description().parameters[i].kind;
        const bool bands = w.mode == ColorMode::rgb_bands;
        if (kind == ParameterKind::wavelength)
            r.set_color(i, v.number > 0. ? Spectral(float(v.number))
                           : bands       ? band_wavelengths()
                                         : w.lambda);
        else if (kind == ParameterKind::spectrum)
            r.set_color(i, v.spectrum ? v.spectrum->eval(w) : Spectral(float(v.number)));
        else
            r.set_scalar(i, float(v.number));
        r.option[i] = int(v.number);
    }
    return r;
}

ValuesF AnyModel::values_float(float nm) const {
    const ValuesD d = values_double(nm);
    ValuesF r;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        r.set_scalar(i, float(d.scalar[i]));
        r.option[i] = d.option[i];
    }
    return r;
}

ValuesD AnyModel::values_double(double nm) const {
    ValuesD r;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Value& v = values_[i];
        double number = v.number;
        if (description().parameters[i].kind == ParameterKind::wavelength && number == 0.)
            number = nm;
        else if (v.spectrum)
            number = v.spectrum->eval(at(float(nm)))[0];
        r.set_scalar(i, number);
        r.option[i] = int(v.number);
    }
    return r;
}

void AnyModel::eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out,
                         float nm) const {
    if (wi.size() != out.size() || wo.size() != out.size())
        throw InputError(
            fmt::format("{}: {} directions wi, {} directions wo and {} results must be "
                        "equally many",
                        description().name, wi.size(), wo.size(), out.size()));
    evaluator_->eval_many(values_float(nm), wi, wo, out);
}

AnyModel make_model(std::string_view name, const Settings& settings, Bounds bounds) {
    return AnyModel(find_evaluator(name), settings, bounds);
}

}  // namespace nacre
