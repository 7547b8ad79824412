// <bsdf type="measured">: reflectance as it was measured, from a file of any format that nacre reads
// (docs/measured.md), or factored (docs/factoring.md).
//   filename   the file, or the folder of factors
//   scale      factor, a number > 0 (1)
// What the file does not hold (angles beyond the measured ones) is said in measured/surface.h. A
// file of reflection alone is black from the inside; wrap it in <bsdf type="twosided">.
#include "nacre/measured/open_measured.h"
#include "nacre/measured/surface.h"
#include "nacre/scene/materials/types.h"
#include "nacre/spectrum/rgb_basis.h"

namespace nacre {
namespace {

/// How channels become the lanes of a path: bands of three bands as they are, otherwise a weight of
/// each channel in each lane.
struct LaneWeights {
    enum class Kind { bands, basis, weights, wavelengths } kind = Kind::bands;
    const Spectral* weight = nullptr;  ///< weights: one a channel
    RgbBasis basis;                    ///< basis: the channels are red, green and blue
    int channel[4] = {};               ///< wavelengths: of each lane, with `part` of the next
    float part[4] = {};
};

class MeasuredBsdf final : public Bsdf {
  public:
    MeasuredBsdf(const MeasuredSurface& surface, float scale, const LaneWeights& lanes)
        : surface_(&surface), scale_(scale), lanes_(lanes) {}

    Spectral eval(const Vec3f& wi, const Vec3f& wo) const override {
        float channels[max_measured_channels];
        surface_->eval(wi, wo, channels);
        return scale_ * lanes_of(channels);
    }
    float pdf(const Vec3f& wi, const Vec3f& wo) const override { return surface_->pdf(wi, wo); }
    BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const override {
        float channels[max_measured_channels];
        const float pdf = surface_->eval_pdf(wi, wo, channels);
        return {scale_ * lanes_of(channels), pdf};
    }
    std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const override {
        float channels[max_measured_channels];
        const auto drawn = surface_->draw(wo, u1, u2, channels);
        if (!drawn || !(drawn->pdf > 0.f)) return std::nullopt;
        BsdfSample s;
        s.wi = drawn->wi;
        s.pdf = drawn->pdf;
        s.weight = scale_ * lanes_of(channels) / s.pdf;
        return s;
    }

  private:
    Spectral lanes_of(const float* channels) const {
        switch (lanes_.kind) {
            case LaneWeights::Kind::bands:
                return {channels[0], channels[1], channels[2], 0.f};
            case LaneWeights::Kind::basis:
                return lanes_.basis.eval({channels[0], channels[1], channels[2]});
            case LaneWeights::Kind::weights: {
                Spectral sum(0.f);
                for (int c = 0; c < surface_->info().channels; ++c)
                    sum += channels[c] * lanes_.weight[c];
                return max(sum, Spectral(0.f));  // colours outside sRGB
            }
            case LaneWeights::Kind::wavelengths:
                break;
        }
        Spectral value(0.f);
        for (int k = 0; k < 4; ++k) {
            const int c = lanes_.channel[k];
            value.set(k, channels[c] + (channels[c + 1] - channels[c]) * lanes_.part[k]);
        }
        return value;
    }

    const MeasuredSurface* surface_;
    float scale_;
    LaneWeights lanes_;
};

class MeasuredMaterial final : public Material {
  public:
    MeasuredMaterial(std::shared_ptr<const MeasuredSurface> surface, float scale)
        : surface_(std::move(surface)), scale_(scale), info_(surface_->info()) {
        if (info_.wavelengths.size() < 2 && info_.channels == 3) return;
        // Unit values give each channel's weight in each band.
        const ChannelColours colours(info_);
        std::vector<double> unit(std::size_t(info_.channels));
        for (std::size_t c = 0; c < unit.size(); ++c) {
            unit[c] = 1.;
            const Vec3d rgb = colours(unit);
            in_bands_.push_back({float(rgb.x), float(rgb.y), float(rgb.z), 0.f});
            unit[c] = 0.;
        }
    }

    unsigned flags() const override {
        return has_smooth | (surface_->reflects() ? reflects : 0u) |
               (surface_->transmits() ? transmits : 0u);
    }
    const Bsdf& at(const SurfacePoint&, const Wavelengths& w, BsdfScratch& scratch) const override {
        return scratch.make<MeasuredBsdf>(*surface_, scale_, lanes(w));
    }
    bool is_spectral() const override { return info_.wavelengths.size() >= 2; }

  private:
    LaneWeights lanes(const Wavelengths& w) const {
        LaneWeights lanes;
        const bool bands = w.mode == ColorMode::rgb_bands;
        if (bands ? !in_bands_.empty() : info_.channels == 1) {
            lanes.kind = LaneWeights::Kind::weights;
            lanes.weight = bands ? in_bands_.data() : &grey_;
        } else if (!bands && info_.wavelengths.size() < 2) {
            lanes.kind = LaneWeights::Kind::basis;
            lanes.basis = RgbBasis(w.lambda);
        } else if (!bands) {
            lanes.kind = LaneWeights::Kind::wavelengths;
            const std::vector<double>& nm = info_.wavelengths;
            for (int k = 0; k < 4; ++k) {  // constant beyond the first and last
                const double at = std::clamp(double(w.lambda[k]), nm.front(), nm.back());
                const auto above = std::upper_bound(nm.begin() + 1, nm.end() - 1, at);
                const int c = int(above - nm.begin()) - 1;
                lanes.channel[k] = c;
                lanes.part[k] = float((at - nm[c]) / (nm[c + 1] - nm[c]));
            }
        }
        return lanes;
    }

    std::shared_ptr<const MeasuredSurface> surface_;
    float scale_;
    const MeasuredInfo& info_;
    std::vector<Spectral> in_bands_;  ///< weights of channels that are not red, green and blue
    Spectral grey_{1.f};
};

}  // namespace

MaterialPtr make_measured(const SceneNode& node, BuildContext& context) {
    const std::filesystem::path file = context.file_or_folder(node, "filename");
    const double scale = node.get_float("scale", 1.);
    if (!(scale > 0. && std::isfinite(scale)))
        node.fail_at("scale",
                     fmt::format("'scale' of {} must be positive; got {}", node.describe(), scale));
    std::shared_ptr<const MeasuredSurface> surface;
    try {
        surface = std::make_shared<MeasuredSurface>(open_measured(file));
    } catch (const InputError& error) {
        node.fail_at("filename", error.what());
    }
    if (surface->black() > 0.01)
        context.warnings.push_back(fmt::format(
            "{}: {:.0f} % of the pairs of directions have no measurement and reflect nothing",
            file.filename().string(), 100. * surface->black()));
    return std::make_shared<MeasuredMaterial>(std::move(surface), float(scale));
}

}  // namespace nacre
