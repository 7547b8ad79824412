#pragma once
// Complete Monte Carlo simulation of light among surfaces and in participating media: the reference
// that everything else is compared with. Homogeneous and heterogeneous media, index-mismatched
// boundaries, any nesting of media; spectral multiple importance sampling over the lanes; no limit
// of depth unless the scene sets one.
//
// In media behind boundaries that refract, next-event estimation is impossible and skipped: the
// path walks (walk.h) and leaves by itself or through guided exits (exit_guide.h). In media that
// light can enter straight (null boundaries, or lights inside), every collision is connected to a
// light.
#include <memory>
#include <unordered_map>

#include "nacre/render/distance_grid.h"
#include "nacre/render/exit_guide.h"
#include "nacre/render/integrator.h"
#include "nacre/render/light_beams.h"
#include "nacre/render/light_chooser.h"
#include "nacre/render/majorant_grid.h"
#include "nacre/render/specular_chain.h"
#include "nacre/scene/integrable_volume.h"

namespace nacre {

class VolumePathTracer : public Integrator {
  public:
    explicit VolumePathTracer(const Scene& scene, const Work& work = {});

    Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                      RayCounts& counts) const override;

    /// What is known of a medium before rendering.
    struct MediumInfo {
        bool connect = true;  ///< lights may be reached in a straight line from inside: next-event
                              ///< estimation is useful
        float size = 0.f;     ///< smallest extent of what it fills; 0 if not known
        MajorantGrid majorants;
        /// Of the extinction, where only it varies in space and its integral is known.
        const IntegrableVolume* integrable = nullptr;
        DistanceGrid grid;
        ExitGuide guide;
        /// Chance that a collision looks for light that was reflected inside before.
        float chain_chance = 0.f;
    };
    const MediumInfo& info(const Medium* medium) const { return media_.at(medium); }

  private:
    friend class VolumePath;
    void prepare(const Medium& medium, const Work& work);

    const Scene& scene_;
    LightChooser lights_;
    LightBeams beams_;
    SpecularChains chains_;
    bool has_null_ = false;
    std::unordered_map<const Medium*, MediumInfo> media_;
};

}  // namespace nacre
