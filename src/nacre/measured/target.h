#pragma once
// What a model is fitted to or compared with: a BRDF in the three bands red, green and blue.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nacre/measured/measured.h"
#include "nacre/reflectance/registry.h"

namespace nacre {

class Target {
  public:
    virtual ~Target() = default;
    /// What it is, for people: "ggx alpha=0.2", "pink-felt.binary".
    virtual std::string name() const = 0;
    /// BRDF, sr^-1, without cosine; nothing where it is not known and below the horizon.
    virtual std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const = 0;
    /// The same of many pairs, as quick as the target allows; as single calls but for rounding.
    virtual std::vector<std::optional<Vec3d>> values(std::span<const Vec3d> wi,
                                                     std::span<const Vec3d> wo) const;
    /// Share of the light from w that is mirrored without blur, beside what `value` gives.
    virtual Vec3d mirror(const Vec3d&) const { return {}; }
    /// Whether it stays the same when the surface turns about its normal.
    virtual bool isotropic() const = 0;
};

/// A model's parameters in the bands red, green and blue; numbers keep their double precision.
std::array<ValuesD, 3> band_values(const AnyModel& model);

/// A model with its parameters set.
class ModelTarget final : public Target {
  public:
    ModelTarget(const AnyModel& model, std::string name);
    std::string name() const override { return name_; }
    std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const override;
    Vec3d mirror(const Vec3d& w) const override;
    /// Found out by turning 64 pairs of directions: values agree within 1e-6 of the larger.
    bool isotropic() const override { return isotropic_; }

  private:
    const Evaluator* evaluator_;
    std::array<ValuesD, 3> values_;
    std::string name_;
    bool isotropic_;
};

/// A measured file of any format, interpolated; in linear red, green and blue (ChannelColours).
class MeasuredTarget final : public Target {
  public:
    MeasuredTarget(std::shared_ptr<const Measured> data, std::string name);
    std::string name() const override { return name_; }
    std::optional<Vec3d> value(const Vec3d& wi, const Vec3d& wo) const override;
    std::vector<std::optional<Vec3d>> values(std::span<const Vec3d> wi,
                                             std::span<const Vec3d> wo) const override;
    bool isotropic() const override { return data_->info().isotropic; }
    const Measured& data() const { return *data_; }

  private:
    std::shared_ptr<const Measured> data_;
    ChannelColours colours_;
    std::string name_;
};

/// A target from what people write: the path of a measured file (formats.h), a folder of factors
/// (factor/textures.h), or a model with settings, "ggx alpha=0.2 fresnel=schlick". Throws InputError
/// as read_measured, read_factors, find_evaluator and AnyModel do.
std::unique_ptr<Target> make_target(const std::string& text);

/// A model as people write it, "ward variant=duer": its name and what is set. Throws InputError.
struct ModelSpec {
    std::string name;
    Settings settings;
};
ModelSpec parse_model_spec(std::string_view text);

}  // namespace nacre
