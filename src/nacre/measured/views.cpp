#include "nacre/measured/views.h"

#include <cmath>
#include <numbers>

#include "nacre/math/error.h"

namespace nacre {
namespace {

class View : public Measured {
  public:
    void for_each_sample(const std::function<void(const MeasuredSample&)>&) const override {}
};

MeasuredInfo info_of_model(std::string name, bool isotropic) {
    MeasuredInfo info;
    info.description = std::move(name);
    info.parameterisation = "a model: any pair of directions";
    info.scale = "none: sr^-1";
    info.isotropic = isotropic;
    info.largest_incidence = info.largest_exit = 90.;
    return info;
}

class TargetView final : public View {
  public:
    explicit TargetView(std::shared_ptr<const Target> target) : target_(std::move(target)) {
        info_ = info_of_model(target_->name(), target_->isotropic());
    }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override {
        const auto value = target_->value(wi, wo);
        for (int c = 0; c < 3 && value; ++c) out[c] = (*value)[c];
        return value.has_value();
    }

  private:
    std::shared_ptr<const Target> target_;
};

class SpectralView final : public View {
  public:
    SpectralView(const AnyModel& model, std::string name, std::vector<double> wavelengths)
        : evaluator_(&model.evaluator()) {
        for (const double nm : wavelengths) values_.push_back(model.values_double(nm));
        info_ = info_of_model(name, ModelTarget(model, name).isotropic());
        info_.channels = int(wavelengths.size());
        info_.wavelengths = std::move(wavelengths);
    }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override {
        if (!(wi.z > 0. && wo.z > 0.)) return false;
        for (std::size_t c = 0; c < values_.size(); ++c)
            out[c] = evaluator_->eval(values_[c], wi, wo);
        return true;
    }

  private:
    const Evaluator* evaluator_;
    std::vector<ValuesD> values_;
};

class ColourView final : public View {
  public:
    explicit ColourView(std::shared_ptr<const Measured> data)
        : data_(std::move(data)), colours_(data_->info()) {
        info_ = data_->info();
        info_.channels = 3;
        info_.wavelengths.clear();
    }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override {
        double channels[max_measured_channels];
        const std::span<double> values(channels, std::size_t(data_->info().channels));
        if (!data_->eval(wi, wo, values)) return false;
        const Vec3d colour = colours_(values);
        for (int c = 0; c < 3; ++c) out[c] = colour[c];
        return true;
    }
    void for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const override {
        data_->for_each_sample([&](const MeasuredSample& s) {
            double channels[3] = {};
            if (s.state != SampleState::missing) {
                const Vec3d colour = colours_(s.value);
                for (int c = 0; c < 3; ++c) channels[c] = colour[c];
            }
            visit({s.wi, s.wo, s.state, channels});
        });
    }

  private:
    std::shared_ptr<const Measured> data_;
    ChannelColours colours_;
};

class TurnedView final : public View {
  public:
    explicit TurnedView(std::shared_ptr<const Measured> data) : data_(std::move(data)) {
        info_ = data_->info();
        info_.isotropic = true;
        info_.samples = info_.missing = info_.negative = 0;  // it has none of its own
    }
    bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const override {
        constexpr int turns = 32;
        double channels[max_measured_channels];
        const std::size_t n = std::size_t(info_.channels);
        int found = 0;
        std::fill_n(out.begin(), n, 0.);
        for (int k = 0; k < 2 * turns; ++k) {
            const double angle = 2. * std::numbers::pi * (k / 2) / turns, side = k % 2 ? -1. : 1.;
            const double c = std::cos(angle), s = std::sin(angle);
            const auto turned = [&](const Vec3d& w) {
                return Vec3d{c * w.x - s * side * w.y, s * w.x + c * side * w.y, w.z};
            };
            if (!data_->eval(turned(wi), turned(wo), std::span<double>(channels, n))) continue;
            ++found;
            for (std::size_t i = 0; i < n; ++i) out[i] += channels[i];
        }
        if (found < turns) return false;
        for (std::size_t i = 0; i < n; ++i) out[i] /= found;
        return true;
    }

  private:
    std::shared_ptr<const Measured> data_;
};

}  // namespace

std::shared_ptr<const Measured> view_of(std::shared_ptr<const Target> target) {
    return std::make_shared<TargetView>(std::move(target));
}

std::shared_ptr<const Measured> view_of(const AnyModel& model, std::string name,
                                        std::vector<double> wavelengths) {
    if (wavelengths.empty() || wavelengths.size() > std::size_t(max_measured_channels))
        throw InputError(fmt::format("{} wavelengths; there must be 1 to {}", wavelengths.size(),
                                     max_measured_channels));
    for (std::size_t i = 0; i < wavelengths.size(); ++i)
        if (!(wavelengths[i] > (i ? wavelengths[i - 1] : 0.)))
            throw InputError(
                fmt::format("wavelengths must be positive and ascend, but {:g} {}", wavelengths[i],
                            i ? fmt::format("follows {:g}", wavelengths[i - 1]) : "is the first"));
    return std::make_shared<SpectralView>(model, std::move(name), std::move(wavelengths));
}

std::shared_ptr<const Measured> in_colour(std::shared_ptr<const Measured> data) {
    const MeasuredInfo& i = data->info();
    if (i.channels == 3 && i.wavelengths.empty()) return data;
    return std::make_shared<ColourView>(std::move(data));
}

std::shared_ptr<const Measured> turned_around(std::shared_ptr<const Measured> data) {
    if (data->info().isotropic) return data;
    return std::make_shared<TurnedView>(std::move(data));
}

}  // namespace nacre
