#pragma once
// Light diffusion solved inside the object itself, by multigrid on a grid of cells that the surface
// cuts: curvature, thin parts, cavities and uneven matter count.
//
//   T. Haber, T. Mertens, P. Bekaert, F. Van Reeth 2005, A computational approach to simulate
//   subsurface light diffusion in arbitrarily shaped objects, Graphics Interface 2005.
//
// Light enters as power that is first scattered along refracted rays (their case of volumetric
// sources: Q = sigma_s' times the reduced intensity) or, on grids too coarse for that, at the
// surface (q = 4 Gamma / (1 - Fdr)). What leaves is phi / (2 A), or (phi / 2 - Gamma) / A, by the
// boundary's stencil. nacre's own: cells are cut exactly (diffusion/cut_cells.h), the boundary is
// the symmetric one-point one (diffusion/problem.h), and cells are all of one size instead of an
// octree's: the boundary's stencil is as good, and a hundred times a hundred times a hundred cells
// are solved in a second.
#include "nacre/diffusion/system.h"
#include "nacre/subsurface/diffusion_light.h"
#include "nacre/subsurface/single_scattering.h"
#include "nacre/technique/technique.h"

namespace nacre {

/// The technique's own parameters.
struct DiffusionGridOptions {
    int cells = 0;  ///< along the longest side; 0: two a transport mean free path, within reason
    enum class Source { automatic, volume, surface } source = Source::automatic;
    int samples = 8;                                        ///< paths for each h^2 of the surface
    double tolerance = 1e-6;                                ///< of the solution
    enum class Start { fresh, last } start = Start::fresh;  ///< after a change of light
};

/// Cells along the longest side of a mesh that resolve half a transport mean free path, or as many
/// as two million cells allow.
int automatic_cells(const Mesh& mesh, double free_path);

class DiffusionGrid final : public Translucency {
  public:
    /// What does not depend on light.
    struct Matter {
        const Scene& scene;
        std::uint32_t shape;
        Bands bands;
        DiffusionGridOptions options;
        EntrySource source;
        std::uint64_t seed;
        std::shared_ptr<const CellGrid> grid;
        /// Of each group of bands; several are built again for each light, one is kept.
        std::vector<DiffusionMatter> groups;
        std::unique_ptr<DiffusionSystem> system;
        double surface_factor = 1.;  ///< 4 / (1 - Fdr)
        std::vector<float> factors;  ///< of what leaves, in each band
        bool single = false;         ///< light scattered once is added
    };

    /// `last`: the field under the light before, or null.
    DiffusionGrid(const ObjectBoundary& boundary, std::shared_ptr<Matter> matter,
                  const Relight& now, const DiffusionGrid* last);

    Emergence emerge(const SurfacePoint& exit, const Vec3f& wo, Sampler& sampler,
                     const Wavelengths& wavelengths, RayCounts& counts) const override;
    TranslucencyPtr relit(const Relight& now) const override;

  private:
    void solve_group(int g, const Relight& now, const DiffusionGrid* last);

    std::shared_ptr<Matter> matter_;
    std::vector<std::vector<BandDoubles>> phi_, flux_;  // of each group
    std::unique_ptr<SingleScatteringTerm> single_;      // or null
};

}  // namespace nacre
