#include "nacre/technique/path_technique.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/render/path_tracer.h"
#include "nacre/technique/common_parameters.h"
#include "nacre/technique/rough_half_space.h"

namespace nacre {
namespace {

/// Calls `f` so that what it refuses names the place in the scene file.
template <class F>
auto at_place(const ShapeTechnique& shape, F&& f) {
    try {
        return f();
    } catch (const InputError& error) {
        throw InputError(shape.place + error.what());
    }
}

/// What a translucent shape is to light on its way to another place: a Lambert surface that returns
/// what the boundary and the medium do on average. Its mirror images of lamps would be found by one
/// path in thousands and show as bright points.
class StandIn final : public Translucency {
  public:
    StandIn(std::shared_ptr<const ProfileTables> profile, float mirror, float below)
        : Translucency(1.f), profile_(std::move(profile)), mirror_(mirror), below_(below) {}

    Emergence emerge(const SurfacePoint& exit, const Vec3f&, Sampler&, const Wavelengths& w,
                     RayCounts&) const override {
        return {Spectral(0.f), exit, Spectral(mirror_) + Spectral(below_) * profile_->total(w)};
    }

  private:
    std::shared_ptr<const ProfileTables> profile_;
    float mirror_, below_;
};

TranslucencyPtr make_stand_in(const ShapeInput& in) {
    const float mirror = float(in.boundary.mean_reflectance());
    const float enters =
        in.boundary.rough() ? float(in.boundary.mean_transmittance()) : 1.f - mirror;
    return std::make_shared<StandIn>(profile_tables(in), mirror, enters * enters * exit_scale(in));
}

class PathTechnique final : public Technique {
  public:
    PathTechnique(const TechniqueInput& input, const Work& work)
        : scene_(input.scene), shapes_(input.shapes), seed_(input.seed) {
        prepare({}, work);
    }

    RenderResult render(const FrameSettings& frame, const RenderOptions& options) override {
        RenderResult result = nacre::render(scene_, *tracer_, frame, options);
        result.integrator = "path";
        result.statistics = statistics_;
        return result;
    }
    void changed(const Changes& what, const Work& work) override {
        if (!what.within({.view = true})) prepare(what, work);
    }
    Statistics statistics() const override { return statistics_; }

  private:
    // Makes everything but the matter that was made before and that these changes leave alone.
    void prepare(const Changes& what, const Work& work) {
        Statistics statistics;
        surfaces_.clear();
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) surfaces_.push_back(surface_of(i, work));
        Translucencies local(shapes_.size());
        for (std::uint32_t i = 0; i < shapes_.size(); ++i)
            if (shapes_[i].technique) local[i] = make(i, make_stand_in, nullptr, statistics, work);
        // Its paths are averaged over, so they may end early: an object that stands on a floor sees
        // light go to and fro in the gap for ever.
        const PathTracer light(scene_, local, 2);
        matter_.resize(shapes_.size());
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            const TechniqueDescription* technique = shapes_[i].technique;
            if (!technique) continue;
            if (matter_[i] && what.within(technique->keeps)) {
                if (TranslucencyPtr relit =
                        what.light ? matter_[i]->relit({light, statistics, work}) : nullptr)
                    matter_[i] = std::move(relit);
                continue;
            }
            matter_[i] = make(i, technique->below, &light, statistics, work);
        }
        tracer_ = std::make_unique<PathTracer>(scene_, matter_);
        statistics_ = std::move(statistics);
    }

    TranslucencyPtr make(std::uint32_t i, TranslucencyPtr (*maker)(const ShapeInput&),
                         const PathTracer* light, Statistics& statistics, const Work& work) {
        const ShapeTechnique& shape = shapes_[i];
        return at_place(shape, [&] {
            refuse_flat(i);
            return maker({scene_, i, shape.options, shape.profile, surfaces_[i].boundary,
                          surfaces_[i].rough_return, seed_, light, statistics, work});
        });
    }

    /// A sheet has no inside for light to be scattered in.
    void refuse_flat(std::uint32_t i) const {
        const Vec3f size = scene_.rays.bounds(i).diagonal();
        const float least = std::min({size.x, size.y, size.z}),
                    most = std::max({size.x, size.y, size.z});
        if (!(least > 1e-6f * most))
            throw InputError(
                fmt::format("'{}' is flat: it has no inside for light to be scattered "
                            "in; give it a thickness",
                            scene_.shapes[i].name));
    }

    /// What is between a translucent shape's matter and the rest.
    struct Surface {
        ObjectBoundary boundary{1.f};
        std::vector<double> rough_return{};
    };
    Surface surface_of(std::uint32_t i, const Work& work) const {
        if (!shapes_[i].technique) return {};
        return at_place(shapes_[i], [&] {
            const ShapeBinding& shape = scene_.shapes[i];
            Surface s{ObjectBoundary::of(shape)};
            s.rough_return = rough_return(
                s.boundary, medium_in_bands(*shape.interior, s.boundary.eta(), Bands(scene_.mode)),
                work);
            return s;
        });
    }

    const Scene& scene_;
    const std::vector<ShapeTechnique> shapes_;
    const std::uint64_t seed_;
    std::vector<Surface> surfaces_;
    Translucencies matter_;
    std::unique_ptr<PathTracer> tracer_;
    Statistics statistics_;
};

}  // namespace

TechniquePtr prepare_path_technique(const TechniqueInput& input, const Work& work) {
    return std::make_unique<PathTechnique>(input, work);
}

}  // namespace nacre
