// <bsdf type="ward"> and every other model of reflectance/models.h: the parameters, their defaults
// and ranges are those of the model's description (`nacre models show ward`), under its names or
// those of other renderers. Spectra and shapes take numbers or textures. Black from the inside;
// wrap in <bsdf type="twosided"> to see both sides.
#include "nacre/reflectance/registry.h"
#include "nacre/scene/materials/types.h"

namespace nacre {
namespace {

/// A parameter that varies over the surface or with the wavelength.
struct Binding {
    int position;
    ParameterKind kind;
    TexturePtr texture;
    float low = 0.f, high = 0.f;  ///< scalars are clamped to their range
};

class ModelMaterial final : public Material {
  public:
    ModelMaterial(const Evaluator& evaluator, const ValuesS& constants,
                  std::vector<Binding> bindings)
        : evaluator_(evaluator),
          count_(int(evaluator.description().parameters.size())),
          constants_(constants),
          bindings_(std::move(bindings)) {
        const bool varies = std::any_of(bindings_.begin(), bindings_.end(), [](const Binding& b) {
            return b.texture && !b.texture->is_constant();
        });
        if (varies) return;
        kept_ = std::make_unique<BsdfScratch>();
        in_bands_ = &evaluator_.bind(values({}, Wavelengths::rgb_bands()), *kept_);
    }

    unsigned flags() const override {
        return reflects | has_smooth | (evaluator_.has_mirror() ? has_delta : 0u);
    }
    const Bsdf& at(const SurfacePoint& point, const Wavelengths& w,
                   BsdfScratch& scratch) const override {
        if (in_bands_ && w.mode == ColorMode::rgb_bands) return *in_bands_;
        return evaluator_.bind(values(point.uv, w), scratch);
    }
    bool is_spectral() const override {
        return std::any_of(bindings_.begin(), bindings_.end(), [](const Binding& b) {
            return b.kind == ParameterKind::wavelength || (b.texture && b.texture->is_spectral());
        });
    }

  private:
    ValuesS values(Vec2f uv, const Wavelengths& w) const {
        ValuesS v(constants_, count_);
        for (const Binding& b : bindings_) {
            if (b.kind == ParameterKind::spectrum)
                v.set_color(b.position, b.texture->eval(uv, w));
            else if (b.kind == ParameterKind::scalar)
                v.set_scalar(b.position, std::clamp(b.texture->eval_scalar(uv), b.low, b.high));
            else
                v.set_color(b.position,
                            w.mode == ColorMode::rgb_bands ? band_wavelengths() : w.lambda);
        }
        return v;
    }

    const Evaluator& evaluator_;
    int count_;
    ValuesS constants_;
    std::vector<Binding> bindings_;
    // Bound once if no parameter varies over the surface: in RGB bands all paths see the same.
    std::unique_ptr<BsdfScratch> kept_;
    const Bsdf* in_bands_ = nullptr;
};

/// Reads the parameters of one model from a node.
class ModelReader {
  public:
    ModelReader(const SceneNode& node, BuildContext& context)
        : node_(node),
          context_(context),
          evaluator_(find_evaluator(node.type)),
          model_(evaluator_.description()) {}

    MaterialPtr read() {
        for (std::size_t i = 0; i < model_.parameters.size(); ++i) {
            const Parameter& p = model_.parameters[i];
            const std::string name = name_in_file(p);
            try {
                read(int(i), p, name);
            } catch (const ModelError& error) {
                node_.fail_at(name, error.what);
            }
        }
        for (const SumBound& bound : model_.bounds) check(bound);
        return std::make_shared<ModelMaterial>(evaluator_, constants_, std::move(bindings_));
    }

  private:
    struct ModelError {
        std::string what;
    };
    /// Messages of the model, with the place in the file.
    template <class F>
    auto in_file(F&& f) {
        try {
            return f();
        } catch (const InputError& error) {
            throw ModelError{error.what()};
        }
    }

    /// The name under which the parameter is given, or its own.
    std::string name_in_file(const Parameter& p) const {
        std::string found;
        const auto look = [&](std::string_view name) {
            if (!node_.has(name) && !node_.child(name, "texture")) return;
            if (!found.empty())
                node_.fail_at(name, fmt::format("{} takes either '{}' or '{}', not both",
                                                node_.describe(), found, name));
            found = name;
        };
        look(p.name);
        for (std::string_view alias : p.aliases) look(alias);
        return found.empty() ? std::string(p.name) : found;
    }

    void read(int i, const Parameter& p, const std::string& name) {
        switch (p.kind) {
            case ParameterKind::choice: {
                int option = int(p.otherwise);
                if (node_.has(name)) {
                    const std::string word = node_.get_string(name);
                    option = in_file([&] { return find_choice(model_.name, p, word); });
                }
                constants_.option[i] = option;
                return;
            }
            case ParameterKind::integer: {
                const double value = double(node_.get_int(name, std::int64_t(p.otherwise)));
                in_file([&] { check_range(model_.name, p, value); });
                constants_.option[i] = int(value);
                return;
            }
            case ParameterKind::wavelength: {
                const double nm = node_.get_float(name, p.otherwise);
                in_file([&] { check_range(model_.name, p, nm); });
                constants_.set_color(i, Spectral(float(nm)));
                if (nm == 0.) bindings_.push_back({i, p.kind, nullptr});
                return;
            }
            case ParameterKind::scalar:
                if (!node_.child(name, "texture")) {
                    const double value = node_.get_float(name, p.otherwise);
                    in_file([&] { check_range(model_.name, p, value); });
                    constants_.set_scalar(i, float(value));
                    return;
                }
                break;
            case ParameterKind::spectrum:
                break;
        }
        const bool reflectance = p.kind == ParameterKind::spectrum && p.high <= 1.;
        TexturePtr texture =
            reflectance
                ? get_reflectance(node_, name, float(p.otherwise), context_)
                : get_texture(node_, name, ColorRole::unbounded, float(p.otherwise), context_);
        const double max = texture->max();
        in_file([&] {
            check_range(model_.name, p, max <= p.high * 1.00001 ? std::min(max, p.high) : max);
        });
        // The lowest number of an open range that single precision evaluates safely.
        const float low = p.above_low ? std::max(float(p.low) + 1e-4f, 1e-4f) : float(p.low);
        bindings_.push_back({i, p.kind, std::move(texture), low, float(p.high)});
    }

    void check(const SumBound& bound) {
        std::vector<const Texture*> textures;
        bool varies = false;
        std::string names;
        for (std::string_view name : bound.parameters) {
            const int position = find_parameters(model_.name, model_.parameters, name).front();
            for (const Binding& b : bindings_)
                if (b.position == position) textures.push_back(b.texture.get());
            varies = varies ||
                     node_.child(name_in_file(model_.parameters[position]), "texture") != nullptr;
            names += fmt::format("{}{}", names.empty() ? "" : " + ", name);
        }
        const auto sum_at = [&](const Wavelengths& w) {
            Spectral sum(0.f);
            for (const Texture* t : textures) sum += t->eval({}, w);
            return max_lane(sum);
        };
        if (varies) {
            // Where the largest values of two textures meet, if they do, only the pictures know.
            double largest = 0.;
            for (const Texture* t : textures) largest += t->max();
            if (largest > 1. + 1e-4)
                context_.warnings.push_back(fmt::format(
                    "{}: {} may exceed 1 where the textures are brightest ({:.3g}), and "
                    "energy appear from nowhere",
                    node_.describe(), names, largest));
            return;
        }
        const bool spectral = std::any_of(textures.begin(), textures.end(),
                                          [](const Texture* t) { return t->is_spectral(); });
        try {
            check_sum(model_, bound, largest_over_wavelengths(sum_at, spectral));
        } catch (const InputError& error) {
            node_.fail(error.what());
        }
    }

    const SceneNode& node_;
    BuildContext& context_;
    const Evaluator& evaluator_;
    const ModelDescription& model_;
    ValuesS constants_;
    std::vector<Binding> bindings_;
};

}  // namespace

MaterialPtr make_reflectance_model(const SceneNode& node, BuildContext& context) {
    return ModelReader(node, context).read();
}

}  // namespace nacre
