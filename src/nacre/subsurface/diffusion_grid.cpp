#include "nacre/subsurface/diffusion_grid.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/diffusion/memory.h"
#include "nacre/geometry/tessellate.h"
#include "nacre/math/error.h"
#include "nacre/measured/formats.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/subsurface/daylight.h"
#include "nacre/subsurface/diffusion_matter.h"
#include "nacre/subsurface/stopwatch.h"
#include "nacre/technique/common_parameters.h"

namespace nacre {
namespace {

constexpr double most_automatic_cells = 2e6;
constexpr int least_automatic = 24, most_cells = 4096;
// Of the memory that is free, so that a picture still fits.
constexpr double share_of_memory = 0.8;

DiffusionGridOptions options_of(const ParameterValues& values) {
    return {.cells = values.whole("cells"),
            .source = values.choice<DiffusionGridOptions::Source>("source"),
            .samples = values.whole("samples"),
            .tolerance = values.number("tolerance"),
            .start = values.choice<DiffusionGridOptions::Start>("start")};
}

/// The shape as a mesh whose triangles face outwards.
Mesh closed_mesh(const ShapeInput& in) {
    const RayScene& rays = in.scene.rays;
    const Mesh* mesh = rays.mesh(in.shape);
    Mesh result = mesh ? *mesh : tessellate(*rays.primitive(in.shape), 1e-4);
    result.name = in.scene.shapes[in.shape].name;
    double volume = 0.;
    const Vec3d origin(result.bounds().lower);
    for (const Mesh::Triangle& t : result.triangles) {
        const Vec3d a = Vec3d(result.positions[t[0]]) - origin;
        volume += dot(a, cross(Vec3d(result.positions[t[1]]) - origin,
                               Vec3d(result.positions[t[2]]) - origin));
    }
    if (volume < 0.)  // the shape's flip_normals turns them
        for (Mesh::Triangle& t : result.triangles) std::swap(t[1], t[2]);
    return result;
}

void add_statistics(const DiffusionGrid::Matter& m, std::size_t clamped, Statistics& to) {
    const CellGrid& grid = *m.grid;
    to.push_back({"cells", double(grid.size()), ""});
    to.push_back({"cell_size", grid.frame().h, ""});
    to.push_back({"volume_source", m.source == EntrySource::volume ? 1. : 0., ""});
    to.push_back({"thin_cells", double(grid.thin_cells()), ""});
    to.push_back({"unresolved_surface", 100. * grid.thin_area() / grid.area(), "%"});
    to.push_back({"clamped_cells", double(clamped), ""});
}

}  // namespace

int automatic_cells(const Mesh& mesh, double free_path) {
    const Vec3f size = mesh.bounds().diagonal();
    const double longest = std::max({size.x, size.y, size.z});
    const double wanted =
        std::clamp(longest / (0.5 * free_path), double(least_automatic), double(most_cells));
    const auto cells = [&](double n) {
        return diffusion_memory(mesh, GridFrame::around(mesh.bounds(), n)).cells;
    };
    double n = wanted;
    while (n > least_automatic && cells(n) > most_automatic_cells) n *= 0.97;
    return int(std::floor(n));
}

DiffusionGrid::DiffusionGrid(const ObjectBoundary& boundary, std::shared_ptr<Matter> matter,
                             const Relight& now, const DiffusionGrid* last)
    : Translucency(boundary), matter_(std::move(matter)) {
    const int groups = matter_->bands.groups();
    if (matter_->single)
        single_ = std::make_unique<SingleScatteringTerm>(matter_->scene, matter_->shape, boundary);
    phi_.resize(std::size_t(groups));
    flux_.resize(std::size_t(groups));
    for (int g = 0; g < groups; ++g) solve_group(g, now, last);
}

void DiffusionGrid::solve_group(int g, const Relight& now, const DiffusionGrid* last) {
    Matter& m = *matter_;
    const DiffusionMatter& matter = m.groups[std::size_t(g)];
    Stopwatch watch;
    EnteredLight light = entered_light(
        {m.scene, m.shape, boundary(), *m.grid, double(m.options.samples), m.seed, now.work},
        now.light, matter, m.bands, g, m.source);
    const double seconds_light = watch.lap();
    std::unique_ptr<DiffusionSystem> made;
    DiffusionSystem* system = m.system.get();
    if (!system) {
        made = std::make_unique<DiffusionSystem>(m.grid, matter);
        system = made.get();
    }
    std::vector<BandDoubles>& phi = phi_[std::size_t(g)];
    if (last) phi = last->phi_[std::size_t(g)];
    std::vector<BandDoubles> q;
    for (const BandDoubles& flux : light.flux) q.push_back(flux * BandDoubles(m.surface_factor));
    const double seconds_build = watch.lap();
    const SolveReport report =
        system->solve(light.power, q, phi, {.tolerance = m.options.tolerance}, now.work);
    flux_[std::size_t(g)] = std::move(light.flux);
    if (g == 0) {
        add_statistics(m, system->clamped(), now.statistics);
        now.statistics.push_back({"light_seconds", seconds_light, "s"});
        now.statistics.push_back({"build_seconds", seconds_build, "s"});
        now.statistics.push_back({"solve_seconds", watch.lap(), "s"});
        now.statistics.push_back({"cycles", double(report.cycles), ""});
        now.statistics.push_back({"grid_bytes", double(system->bytes()), "bytes"});
        const double entered = sum(light.entered), passed = sum(light.passed);
        now.statistics.push_back({"unscattered", entered > 0. ? 100. * passed / entered : 0., "%"});
    }
    if (m.bands.groups() == 1 && made) m.system = std::move(made);
}

Translucency::Emergence DiffusionGrid::emerge(const SurfacePoint& exit, const Vec3f& wo,
                                              Sampler& sampler, const Wavelengths& w,
                                              RayCounts& counts) const {
    const Matter& m = *matter_;
    const Vec3d p(exit.p), n(exit.ng);
    float out[24];
    for (int g = 0; g < m.bands.groups(); ++g) {
        const DiffusionMatter& matter = m.groups[std::size_t(g)];
        const BandDoubles flux = flux_at(*m.grid, flux_[std::size_t(g)], p);
        const BandDoubles phi = surface_fluence(*m.grid, matter, phi_[std::size_t(g)], p, n,
                                                flux * BandDoubles(m.surface_factor));
        const BandDoubles leaves = max(
            BandDoubles(0.), (phi * BandDoubles(0.5) - flux) * BandDoubles(1. / matter.boundary));
        for (int b = 4 * g; b < std::min(4 * g + 4, m.bands.count()); ++b)
            out[b] = float(leaves[b - 4 * g]) * m.factors[std::size_t(b)];
    }
    Emergence result;
    result.radiance = m.bands.at(out, w) * daylight(w) * Spectral(float(1. / std::numbers::pi));
    if (single_) result.radiance += single_->radiance(exit, wo, sampler, w, counts);
    return result;
}

TranslucencyPtr DiffusionGrid::relit(const Relight& now) const {
    const bool last = matter_->options.start == DiffusionGridOptions::Start::last;
    return std::make_shared<DiffusionGrid>(boundary(), matter_, now, last ? this : nullptr);
}

namespace {

TranslucencyPtr make_diffusion_grid(const ShapeInput& in) {
    const DiffusionGridOptions options = options_of(in.options);
    const Bands bands(in.scene.mode);
    const Mesh mesh = closed_mesh(in);
    const ReducedExtinction sigma = reduced_extinction(in.medium(), bands, mesh.bounds());
    if (!(sigma.most > 0.))
        throw InputError(fmt::format("'{}' has nothing inside that scatters or absorbs light",
                                     in.scene.shapes[in.shape].name));
    const int cells = options.cells > 0 ? options.cells : automatic_cells(mesh, 1. / sigma.most);
    if (const double free = double(available_memory()); free > 0.)
        check_memory(mesh, cells, share_of_memory * free, "cells");
    in.work.begin("diffusion grid");
    Stopwatch watch;
    const double fdr = diffuse_reflectance_internal(in.eta());
    const double boundary = boundary_parameter(in.eta(), BoundaryModel::exact);
    auto matter = std::make_shared<DiffusionGrid::Matter>(DiffusionGrid::Matter{
        .scene = in.scene,
        .shape = in.shape,
        .bands = bands,
        .options = options,
        .source = EntrySource::volume,
        .seed = in.seed,
        .grid = std::make_shared<const CellGrid>(mesh, GridFrame::around(mesh.bounds(), cells)),
        .groups = {},
        .system = nullptr,
        .surface_factor = 4. / (1. - fdr),
        .factors = std::vector<float>(std::size_t(bands.count()), exit_scale(in)),
        .single = in.options.choice<SingleScatteringChoice>("single_scattering") ==
                  SingleScatteringChoice::on});
    if (matter->single && !in.medium().homogeneous())
        throw InputError(
            "light scattered once is added in homogeneous media only; set single_scattering to "
            "off");
    using Source = DiffusionGridOptions::Source;
    if (options.source == Source::surface ||
        (options.source == Source::automatic && matter->grid->frame().h * sigma.most > 1.))
        matter->source = EntrySource::surface;
    for (std::size_t b = 0; b < in.rough_return.size(); ++b)
        matter->factors[b] *= float(in.rough_return[b]);
    for (int g = 0; g < bands.groups(); ++g)
        matter->groups.push_back(diffusion_matter(*matter->grid, in.medium(), bands, g, boundary));
    in.statistics.push_back({"grid_seconds", watch.lap(), "s"});
    return std::make_shared<DiffusionGrid>(in.boundary, std::move(matter),
                                           Translucency::Relight{*in.light, in.statistics, in.work},
                                           nullptr);
}

}  // namespace

/// In the list of techniques/techniques.cpp.
const TechniqueDescription& diffusion_grid_technique() {
    static const TechniqueDescription description{
        .name = "diffusion_grid",
        .title = "diffusion solved by multigrid",
        .authors = "T. Haber, T. Mertens, P. Bekaert, F. Van Reeth",
        .year = 2005,
        .paper =
            "A Computational Approach to Simulate Subsurface Light Diffusion in Arbitrarily Shaped "
            "Objects, Graphics Interface 2005",
        .how =
            "the diffusion equation on a grid inside the object: light is first scattered along "
            "refracted rays, multigrid finds where it wanders, the boundary's stencil what leaves",
        .precomputes = "grid, light that enters, the field",
        .keeps = {.view = true, .light = true},
        .parameters =
            {exit_fresnel_parameter(),
             single_scattering_parameter(),
             {.name = "cells",
              .meaning = "along the longest side of the object; 0: two a transport mean free path "
                         "of the densest band, or as many as two million cells allow",
              .kind = ParameterKind::integer,
              .low = 0.,
              .high = double(most_cells),
              .otherwise = double(DiffusionGridOptions().cells)},
             choice_parameter("source", "where light that enters begins to diffuse",
                              {{"auto",
                                "volume where cells are no larger than a transport mean "
                                "free path, else surface"},
                               {"volume", "where it is first scattered, along refracted rays"},
                               {"surface", "where it enters"}}),
             {.name = "samples",
              .meaning = "paths from each cell's face of the surface",
              .kind = ParameterKind::integer,
              .low = 1.,
              .high = 4096.,
              .otherwise = double(DiffusionGridOptions().samples)},
             {.name = "tolerance",
              .meaning = "of the solution: what may be left of the right side",
              .low = 1e-12,
              .high = 0.1,
              .otherwise = DiffusionGridOptions().tolerance},
             choice_parameter("start", "what is solved from after a change of light",
                              {{"fresh", "nothing: the bits are those of a first solution"},
                               {"last",
                                "the field under the light before: fewer cycles, equal "
                                "within the tolerance"}})},
        .takes_volumes = true,
        .prepare = prepare_path_technique,
        .below = make_diffusion_grid};
    return description;
}

}  // namespace nacre
