#include "nacre/reflectance/registry.h"

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/reflectance/models.h"

namespace nacre {
namespace {

const std::vector<const Evaluator*>& evaluators() {
#define NACRE_LIST_MODEL(Model) &evaluator_of<Model>(),
    static const std::vector<const Evaluator*> all{NACRE_MODELS(NACRE_LIST_MODEL)};
#undef NACRE_LIST_MODEL
    return all;
}

}  // namespace

const Catalogue<ModelDescription>& models() {
    static const Catalogue<ModelDescription> all = [] {
        std::vector<const ModelDescription*> r;
        for (const Evaluator* e : evaluators()) r.push_back(&e->description());
        return Catalogue<ModelDescription>("reflectance model", r);
    }();
    return all;
}

const Evaluator& find_evaluator(std::string_view name) {
    const ModelDescription& model = models().find(name);
    return **std::find_if(evaluators().begin(), evaluators().end(),
                          [&](const Evaluator* e) { return &e->description() == &model; });
}

AnyModel::AnyModel(const Evaluator& evaluator, const Settings& settings, Bounds bounds)
    : evaluator_(&evaluator),
      values_(evaluator.description().name, evaluator.description().parameters, settings) {
    if (bounds == Bounds::enforced) check_bounds();
}

void AnyModel::check_bounds() const {
    for (const SumBound& b : description().bounds) {
        std::vector<int> positions;
        for (std::string_view name : b.parameters)
            positions.push_back(
                find_parameters(description().name, description().parameters, name).front());
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
        const ParameterValues::Value& v = values_[i];
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
        const ParameterValues::Value& v = values_[i];
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
