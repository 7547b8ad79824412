#include "nacre/render/volume_path_tracer.h"

#include <algorithm>
#include <cmath>

#include "nacre/render/boundary_samples.h"
#include "nacre/render/shadow_walk.h"
#include "nacre/render/volume_path.h"

namespace nacre {

namespace {

// The finest the distance grid gets: 128 cells along the longest side are about 10 MB.
constexpr int max_grid_cells = 128;
// And that of heterogeneous media, whose distances save no rays.
constexpr int max_uneven_grid_cells = 64;
constexpr int least_grid_cells = 8;
// Looking for chains costs dozens of rays, for light that has crossed the matter and was then
// reflected. Not tuned.
constexpr float most_chain_chance = 0.2f;
// Cells much smaller than a mean free path tell the walk nothing.
constexpr float cell_in_free_paths = 0.5f;

// The tangent of the angle within which half of the light stays that leaves through a rough
// boundary straight from below; where its roughness varies, of many places together.
float spread_of(const Material& boundary) {
    std::vector<float> tangents;
    const auto add = [&](int samples, std::uint64_t key, Vec2f uv) {
        for_boundary_samples(
            boundary, samples, key, [](Vec2f) { return Vec3f(0.f, 0.f, -1.f); },
            [&](const Vec3f& wi, double, bool back) {
                if (!back) tangents.push_back(std::hypot(wi.x, wi.y) / wi.z);
            },
            uv);
    };
    constexpr int places = 16;  // along each side of the texture
    if (boundary.rough_boundary_eta() > 0.f)
        add(1024, 0, {});
    else
        for (int i = 0; i < places * places; ++i)
            add(16, std::uint64_t(i),
                {(float(i % places) + 0.5f) / places, (float(i / places) + 0.5f) / places});
    if (tangents.empty()) return 0.f;
    const auto middle = tangents.begin() + std::ptrdiff_t(tangents.size() / 2);
    std::ranges::nth_element(tangents, middle);
    return std::max(*middle, 1e-3f);
}

/// Index of a boundary that paths may be guided through, inside over outside; 0 if none.
struct ExitIndex {
    float eta = 0.f;
    bool rough = false;
    bool operator==(const ExitIndex&) const = default;
};
ExitIndex exit_index(const Material& material) {
    if (material.facet_eta() > 1.f) return {material.facet_eta(), true};
    if (material.smooth_boundary_eta() > 1.f) return {material.smooth_boundary_eta(), false};
    return {};
}

/// Whether the shapes of a medium are all alike and nothing but its boundary: then they need not be
/// told apart.
bool is_even(const Scene& scene, const MediumPiece& whole) {
    if (!whole.within.empty() || whole.around.empty()) return false;
    const ExitIndex first = exit_index(*scene.shapes[whole.around.front()].material);
    return first.eta > 0.f && !light_overlaps(scene, whole) &&
           std::ranges::all_of(whole.around, [&](std::uint32_t i) {
               const ShapeBinding& shape = scene.shapes[i];
               return !shape.exterior && exit_index(*shape.material) == first;
           });
}

/// The most that the extinction is anywhere, in a band in which something is scattered.
float thickest_band(const Medium& medium) {
    const Wavelengths rgb = Wavelengths::rgb_bands();
    const Vec3f sigma_t = medium.homogeneous() ? medium.sigma_t->rgb() * medium.scale : Vec3f{};
    const Spectral most = medium.majorant(rgb);
    const Vec3f albedo = medium.albedo_volume ? Vec3f(1.f, 1.f, 1.f) : medium.albedo->rgb();
    float thickest = 0.f;
    for (std::size_t c = 0; c < 3; ++c)
        if (albedo[c] > 0.f)
            thickest = std::max(thickest, medium.homogeneous() ? sigma_t[c] : most[int(c)]);
    return thickest;
}

}  // namespace

VolumePathTracer::VolumePathTracer(const Scene& scene, const Work& work)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(), true),
      beams_(scene, work),
      chains_(scene),
      has_null_(has_null_surfaces(scene)),
      sides_(scene.shapes.size(), {&unknown_, &unknown_, Exit::none}) {
    for (const MediumPtr& medium : scene.media) media_[medium.get()].open = is_open(scene, *medium);
    for (const MediumPtr& medium : scene.media) prepare(*medium, work);
}

void VolumePathTracer::prepare(const Medium& medium, const Work& work) {
    work.check();
    MediumInfo& info = media_[&medium];
    if (!medium.homogeneous()) info.majorants = MajorantGrid(medium);
    if (!medium.albedo_volume)
        info.integrable = dynamic_cast<const IntegrableVolume*>(medium.sigma_t_volume.get());
    const MediumPiece whole = whole_of(scene_, medium);
    const Vec3f extent = whole.bounds.diagonal();
    // A medium on the outside of a shape may have no bounds at all.
    if (!whole.around.empty() && whole.within.empty())
        info.size = std::min({extent.x, extent.y, extent.z});
    if (!chains_.empty()) {
        // Light that is reflected inside has crossed the matter: what is left of it by then.
        const Vec3f sigma = medium.homogeneous() ? medium.sigma_t->rgb() : Vec3f{};
        const float crossed = std::min({sigma.x, sigma.y, sigma.z}) * medium.scale * info.size;
        info.chain_chance = most_chain_chance * std::exp(-0.5f * crossed);
        info.chain_ends_inside = whole.within.empty() && scene_.camera_medium != &medium;
        // Between boundaries all the light may come over several.
        info.chain_by_reach =
            !info.chain_ends_inside || std::ranges::any_of(whole.around, [&](std::uint32_t shape) {
                return scene_.shapes[shape].exterior != nullptr;
            });
        if (info.chain_by_reach) info.chain_chance = most_chain_chance;
    }
    if (scene_.camera_medium == &medium) return;

    const int most_cells = medium.homogeneous() ? max_grid_cells : max_uneven_grid_cells;
    if (!scene_.integrator.guided_exits || is_even(scene_, whole)) {
        if (!whole.around.empty() && whole.within.empty())
            add_piece(medium, whole, most_cells, work);
        return;
    }
    const std::vector<MediumPiece> pieces = pieces_of(scene_, whole);
    // Many grids together are no larger than one.
    const float share = std::cbrt(static_cast<float>(pieces.size()));
    for (const MediumPiece& piece : pieces)
        add_piece(medium, piece, std::max(least_grid_cells, int(float(most_cells) / share)), work);
}

void VolumePathTracer::add_piece(const Medium& medium, const MediumPiece& shapes, int most_cells,
                                 const Work& work) {
    Piece& piece = pieces_.emplace_back();
    for (const std::uint32_t shape : shapes.around) sides_[shape].inside = &piece;
    for (const std::uint32_t shape : shapes.within) sides_[shape].outside = &piece;
    const bool refracts_everywhere = std::ranges::none_of(shapes.around, [&](std::uint32_t shape) {
        return scene_.shapes[shape].material->flags() & has_null;
    });
    std::vector<ExitBoundary> exits;
    if (scene_.integrator.guided_exits) {
        const std::vector<LightPtr> inside = lights_inside(scene_, shapes);
        piece.connect = !refracts_everywhere || !inside.empty();
        if (refracts_everywhere && !inside.empty())
            piece.reachable.emplace(inside, scene_.rays.bounds(), true);
        exits = exit_boundaries(shapes);
        for (ExitBoundary& exit : exits) exit.lights_inside = inside;
    } else {
        piece.connect =
            !medium.homogeneous() || !refracts_everywhere || light_overlaps(scene_, shapes);
    }
    // Exits are guided from the grid's cells, whether or not its distances save rays. Elsewhere than
    // in homogeneous media those save none.
    const bool distances = scene_.integrator.distance_grid && medium.homogeneous();
    // Where nothing is scattered, paths do not collide.
    const float thickest = thickest_band(medium);
    if (!(distances || !exits.empty()) || !(thickest > 0.f)) return;
    piece.grid =
        DistanceGrid(scene_.rays, shapes.bounds, cell_in_free_paths / thickest, most_cells, work);
    std::int32_t first = 0;
    for (const ExitBoundary& exit : exits) {
        const ExitGuide& guide =
            piece.guides.emplace_back(scene_, medium, exit, piece.grid, skies_, work, first);
        first += guide.size();
        for (const std::uint32_t shape : exit.shapes)
            sides_[shape].exit = exit.spread > 0.f ? Exit::rough : Exit::smooth;
    }
    if (!distances) piece.grid.forget_distances();
}

std::vector<ExitBoundary> VolumePathTracer::exit_boundaries(const MediumPiece& shapes) const {
    std::vector<ExitBoundary> exits;
    std::vector<ExitIndex> indices;
    for (const std::uint32_t i : shapes.around) {
        const ShapeBinding& shape = scene_.shapes[i];
        const ExitIndex index = exit_index(*shape.material);
        if (!(index.eta > 0.f) || (shape.exterior && !info(shape.exterior).open)) continue;
        const auto known = std::ranges::find(indices, index) - indices.begin();
        if (known == std::ssize(indices)) {
            indices.push_back(index);
            exits.emplace_back().eta = index.eta;
        }
        ExitBoundary& exit = exits[std::size_t(known)];
        exit.shapes.push_back(i);
        if (index.rough) exit.spread = std::max(exit.spread, spread_of(*shape.material));
    }
    for (const ExitBoundary& exit : exits)
        for (ExitBoundary& other : exits)
            if (&other != &exit)
                other.others.insert(other.others.end(), exit.shapes.begin(), exit.shapes.end());
    return exits;
}

Spectral VolumePathTracer::radiance(const Ray& ray, Sampler& sampler,
                                    const Wavelengths& wavelengths, RayCounts& counts) const {
    return VolumePath(*this, ray, sampler, wavelengths, counts).trace();
}

}  // namespace nacre
