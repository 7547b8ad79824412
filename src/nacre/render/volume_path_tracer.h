#pragma once
// Complete Monte Carlo simulation of light among surfaces and in participating media: the reference
// that everything else is compared with. Homogeneous and heterogeneous media, index-mismatched
// boundaries, any nesting of media; spectral multiple importance sampling over the lanes; no limit
// of depth unless the scene sets one.
//
// In media behind boundaries that refract, next-event estimation is impossible and skipped: the
// path walks (walk.h) and leaves by itself or through guided exits (exit_guide.h). In media that
// light can enter straight (null boundaries, or lights inside), every collision is connected to a
// light. Both are decided for each piece of a medium and each of its shapes (medium_pieces.h).
#include <deque>
#include <memory>
#include <optional>
#include <unordered_map>

#include "nacre/render/distance_grid.h"
#include "nacre/render/exit_guide.h"
#include "nacre/render/integrator.h"
#include "nacre/render/light_beams.h"
#include "nacre/render/light_chooser.h"
#include "nacre/render/majorant_grid.h"
#include "nacre/render/medium_pieces.h"
#include "nacre/render/specular_chain.h"
#include "nacre/scene/integrable_volume.h"

namespace nacre {

class VolumePathTracer : public Integrator {
  public:
    explicit VolumePathTracer(const Scene& scene, const Work& work = {});
    VolumePathTracer(const VolumePathTracer&) = delete;
    VolumePathTracer& operator=(const VolumePathTracer&) = delete;

    Spectral radiance(const Ray& ray, Sampler& sampler, const Wavelengths& wavelengths,
                      RayCounts& counts) const override;

    /// What is known of a medium before rendering.
    struct MediumInfo {
        bool open = true;  ///< light may come straight into it from outside
        float size = 0.f;  ///< smallest extent of what it fills; 0 if not known
        MajorantGrid majorants;
        /// Of the extinction, where only it varies in space and its integral is known.
        const IntegrableVolume* integrable = nullptr;
        /// Chance that a collision looks for light that comes over several boundaries; whether it
        /// does so within a reach alone (VolumePath::Reach), as where much light comes by such ways;
        /// and whether the last boundary can only have led into a shape.
        float chain_chance = 0.f;
        bool chain_by_reach = false;
        bool chain_ends_inside = true;
    };
    const MediumInfo& info(const Medium* medium) const { return media_.at(medium); }

    /// What is known of a piece of a medium.
    struct Piece {
        bool connect = true;  ///< lights may be reached in a straight line from inside: next-event
                              ///< estimation is useful
        std::optional<LightChooser> reachable;  ///< those; empty: any
        DistanceGrid grid;
        std::vector<ExitGuide> guides;
        /// `index`: what the grid holds; not -1.
        ExitGuide::Proposal proposal(const Point3f& p, std::int32_t index) const {
            std::size_t g = 0;
            while (index >= guides[g].size()) index -= guides[g++].size();
            return guides[g].at(p, index);
        }
    };
    /// The piece on one side of a shape.
    const Piece& piece(std::uint32_t shape, bool inside) const {
        const Sides& sides = sides_[shape];
        return inside ? *sides.inside : *sides.outside;
    }

    /// How paths are guided out through a shape.
    enum class Exit : unsigned char { none, smooth, rough };
    Exit exit(std::uint32_t shape) const { return sides_[shape].exit; }

  private:
    friend class VolumePath;
    struct Sides {
        const Piece *inside = nullptr, *outside = nullptr;
        Exit exit = Exit::none;
    };
    void prepare(const Medium& medium, const Work& work);
    void add_piece(const Medium& medium, const MediumPiece& shapes, int most_cells,
                   const Work& work);
    std::vector<ExitBoundary> exit_boundaries(const MediumPiece& shapes) const;

    const Scene& scene_;
    LightChooser lights_;
    LightBeams beams_;
    SpecularChains chains_;
    bool has_null_ = false;
    std::unordered_map<const Medium*, MediumInfo> media_;
    const Piece unknown_{};     // of whose shapes nothing is known
    GuideSkies skies_;          // of the guides
    std::deque<Piece> pieces_;  // stay where they are
    std::vector<Sides> sides_;  // of each shape
};

}  // namespace nacre
