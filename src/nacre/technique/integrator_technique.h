#pragma once
// Integrators as techniques: what traces paths for the whole picture, and knows no shape's matter
// by anything but its medium.
#include <functional>

#include "nacre/technique/technique.h"

namespace nacre {

class IntegratorTechnique final : public Technique {
  public:
    using Make = std::function<std::unique_ptr<Integrator>(const Scene& scene, const Work& work)>;

    /// `name` is what pictures say rendered them; `scene` outlives it. Making the integrator is all
    /// that is precomputed.
    IntegratorTechnique(const Scene& scene, std::string name, Make make, const Work& work)
        : scene_(scene),
          name_(std::move(name)),
          make_(std::move(make)),
          integrator_(make_(scene_, work)) {}

    RenderResult render(const FrameSettings& frame, const RenderOptions& options) override;
    void changed(const Changes& what, const Work& work) override;
    Statistics statistics() const override { return integrator_->statistics(); }

  private:
    const Scene& scene_;
    std::string name_;
    Make make_;
    std::unique_ptr<Integrator> integrator_;
};

/// "volpath": complete simulation (render/volume_path_tracer.h).
const TechniqueDescription& simulation_technique();

}  // namespace nacre
