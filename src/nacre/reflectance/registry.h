#pragma once
// Models by name: what the scene reader, the command line, the checks and the documentation use.
#include <functional>

#include "nacre/catalogue/catalogue.h"
#include "nacre/catalogue/settings.h"
#include "nacre/reflectance/evaluator.h"
#include "nacre/spectrum/spectrum.h"

namespace nacre {

/// The descriptions of all models, in the order of models.h.
const Catalogue<ModelDescription>& models();
/// The evaluator of a model; throws InputError as models().find does.
const Evaluator& find_evaluator(std::string_view name);

/// Whether sums such as kd + ks <= 1 are enforced, or only the range of each parameter.
enum class Bounds { enforced, ranges_only };

/// Throws InputError if a sum exceeds 1.
void check_sum(const ModelDescription& model, const SumBound& bound, double sum);
/// The largest that f becomes in RGB bands and, if asked, over the visible range in steps of 5 nm.
/// Who wrote RGB means bands: the ends of uplifted spectra are nobody's choice.
float largest_over_wavelengths(const std::function<float(const Wavelengths&)>& f, bool spectral);

/// What models that depend on the wavelength see where the lanes are red, green and blue: the
/// dominant wavelengths of the sRGB primaries under D65 (611.4, 549.1, 464.2 nm; CIE 1931).
Spectral band_wavelengths();

/// A model with its parameters set.
class AnyModel {
  public:
    /// Parameters that are not given keep their defaults. Throws InputError as ParameterValues does,
    /// and for sums that exceed their bound.
    AnyModel(const Evaluator& evaluator, const Settings& settings,
             Bounds bounds = Bounds::enforced);

    const ModelDescription& description() const { return evaluator_->description(); }
    const Evaluator& evaluator() const { return *evaluator_; }

    /// BRDF in sr^-1 at one wavelength (nm).
    double eval(const Vec3d& wi, const Vec3d& wo, double nm = 550.) const {
        return evaluator_->eval(values_double(nm), wi, wo);
    }
    float eval(const Vec3f& wi, const Vec3f& wo, float nm = 550.f) const {
        return evaluator_->eval(values_float(nm), wi, wo);
    }
    Spectral eval(const Vec3f& wi, const Vec3f& wo, const Wavelengths& w) const {
        return evaluator_->eval(values(w), wi, wo);
    }
    /// Many pairs of directions at one wavelength, in packs. Throws InputError unless the spans
    /// have equal lengths.
    void eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out,
                   float nm = 550.f) const;

    Vec3f sample(const Vec3f& wo, float u1, Vec2f u2, float nm = 550.f) const {
        return evaluator_->sample(values(at(nm)), wo, u1, u2);
    }
    double pdf(const Vec3d& wi, const Vec3d& wo, double nm = 550.) const {
        return evaluator_->pdf(values_double(nm), wi, wo);
    }
    /// Share of the light that is mirrored without blur; 0 for models without.
    double mirror(const Vec3d& wo, double nm = 550.) const {
        return evaluator_->mirror(values_double(nm), wo);
    }
    /// Albedo of light from wi, without the mirror part, if a closed form is known.
    std::optional<double> albedo(const Vec3d& wi, double nm = 550.) const {
        return evaluator_->albedo(values_double(nm), wi);
    }

    /// The flat list of values that the evaluator takes.
    ValuesD values_double(double nm) const;
    ValuesF values_float(float nm) const;
    ValuesS values(const Wavelengths& w) const;

  private:
    static Wavelengths at(float nm);
    void check_bounds() const;

    const Evaluator* evaluator_;
    ParameterValues values_;
};

/// A model by name. Throws InputError as find_evaluator and AnyModel do.
AnyModel make_model(std::string_view name, const Settings& settings = {},
                    Bounds bounds = Bounds::enforced);

}  // namespace nacre
