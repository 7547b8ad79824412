#include "nacre/measured/target.h"

#include <numbers>

#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/measured/factor/textures.h"
#include "nacre/measured/formats.h"

namespace nacre {

std::vector<std::optional<Vec3d>> Target::values(std::span<const Vec3d> wi,
                                                 std::span<const Vec3d> wo) const {
    std::vector<std::optional<Vec3d>> all;
    for (std::size_t i = 0; i < wi.size(); ++i) all.push_back(value(wi[i], wo[i]));
    return all;
}

std::array<ValuesD, 3> band_values(const AnyModel& model) {
    const ValuesD exact = model.values_double(550.);
    const ValuesS bands = model.values(Wavelengths::rgb_bands());
    std::array<ValuesD, 3> r{exact, exact, exact};
    const auto& parameters = model.description().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const ParameterKind kind = parameters[i].kind;
        if (kind != ParameterKind::spectrum && kind != ParameterKind::wavelength) continue;
        for (int c = 0; c < 3; ++c)
            if (bands.color[i][c] != float(exact.color[i]))
                r[c].set_scalar(int(i), bands.color[i][c]);
    }
    return r;
}

ModelTarget::ModelTarget(const AnyModel& model, std::string name)
    : evaluator_(&model.evaluator()), values_(band_values(model)), name_(std::move(name)) {
    Random random(stream_key(3, 1));
    isotropic_ = true;
    for (int i = 0; i < 64 && isotropic_; ++i) {
        const auto direction = [](double z, double phi) {
            const double s = std::sqrt(1. - z * z);
            return Vec3d{s * std::cos(phi), s * std::sin(phi), z};
        };
        const double zi = 0.05 + 0.9 * random.next(), a = 6. * random.next();
        const double zo = i % 2 ? zi * (0.9 + 0.1 * random.next()) : 0.05 + 0.9 * random.next();
        const double b = i % 2 ? a + std::numbers::pi + 0.1 * random.next() : 6. * random.next();
        const double turn = 6. * random.next();
        const double f = evaluator_->eval(values_[1], direction(zi, a), direction(zo, b));
        const double g =
            evaluator_->eval(values_[1], direction(zi, a + turn), direction(zo, b + turn));
        isotropic_ = std::abs(f - g) <= 1e-6 * std::max(f, g);
    }
}

std::optional<Vec3d> ModelTarget::value(const Vec3d& wi, const Vec3d& wo) const {
    if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
    return Vec3d{evaluator_->eval(values_[0], wi, wo), evaluator_->eval(values_[1], wi, wo),
                 evaluator_->eval(values_[2], wi, wo)};
}

Vec3d ModelTarget::mirror(const Vec3d& w) const {
    return {evaluator_->mirror(values_[0], w), evaluator_->mirror(values_[1], w),
            evaluator_->mirror(values_[2], w)};
}

ModelSpec parse_model_spec(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (begin == end) throw InputError("a model is missing: write its name, such as 'ward'");
    return {std::string(text.substr(begin, end - begin)), parse_settings(text.substr(end))};
}

MeasuredTarget::MeasuredTarget(std::shared_ptr<const Measured> data, std::string name)
    : data_(std::move(data)), colours_(data_->info()), name_(std::move(name)) {}

std::optional<Vec3d> MeasuredTarget::value(const Vec3d& wi, const Vec3d& wo) const {
    if (!(wi.z > 0. && wo.z > 0.)) return std::nullopt;
    double channels[max_measured_channels];
    const std::span<double> out(channels, std::size_t(data_->info().channels));
    if (!data_->eval(wi, wo, out)) return std::nullopt;
    return colours_(out);
}

std::vector<std::optional<Vec3d>> MeasuredTarget::values(std::span<const Vec3d> wi,
                                                         std::span<const Vec3d> wo) const {
    const std::size_t n = std::size_t(data_->info().channels);
    std::vector<double> out(n * wi.size());
    const auto known = std::make_unique<bool[]>(wi.size());
    data_->eval_many(wi, wo, out, {known.get(), wi.size()});
    std::vector<std::optional<Vec3d>> all(wi.size());
    for (std::size_t i = 0; i < wi.size(); ++i)
        if (known[i] && wi[i].z > 0. && wo[i].z > 0.)
            all[i] = colours_(std::span(out).subspan(i * n, n));
    return all;
}

std::unique_ptr<Target> make_target(const std::string& text) {
    const std::filesystem::path path(text);
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return std::make_unique<FactoredBrdf>(read_factors(path));
    bool file = std::filesystem::is_regular_file(path, ignored);
    // A name that ends like a file is one, be it there or not.
    for (const MeasuredFormat* format : measured_formats())
        file = file || path.extension() == format->ending;
    if (file)
        return std::make_unique<MeasuredTarget>(read_measured(path), path.filename().string());
    const ModelSpec spec = parse_model_spec(text);
    return std::make_unique<ModelTarget>(make_model(spec.name, spec.settings), text);
}

}  // namespace nacre
