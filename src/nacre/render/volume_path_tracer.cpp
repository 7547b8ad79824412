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
// Looking for chains costs dozens of rays, for light that has crossed the matter and was then
// reflected. Not tuned.
constexpr float most_chain_chance = 0.2f;
// Cells much smaller than a mean free path tell the walk nothing.
constexpr float cell_in_free_paths = 0.5f;

bool overlap(const Box3f& a, const Box3f& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

// The tangent of the angle within which half of the light stays that leaves through a rough
// boundary straight from below.
float spread_of(const Material& boundary) {
    std::vector<float> tangents;
    for_boundary_samples(
        boundary, 1024, 0, [](Vec2f) { return Vec3f(0.f, 0.f, -1.f); },
        [&](const Vec3f& wi, double, bool back) {
            if (!back) tangents.push_back(std::hypot(wi.x, wi.y) / wi.z);
        });
    if (tangents.empty()) return 0.f;
    const auto middle = tangents.begin() + std::ptrdiff_t(tangents.size() / 2);
    std::ranges::nth_element(tangents, middle);
    return std::max(*middle, 1e-3f);
}

}  // namespace

VolumePathTracer::VolumePathTracer(const Scene& scene, const Work& work)
    : scene_(scene),
      lights_(scene.lights, scene.rays.bounds(), true),
      beams_(scene, work),
      chains_(scene),
      has_null_(has_null_surfaces(scene)) {
    for (const MediumPtr& medium : scene.media) prepare(*medium, work);
}

void VolumePathTracer::prepare(const Medium& medium, const Work& work) {
    work.check();
    MediumInfo& info = media_[&medium];
    if (!medium.homogeneous()) info.majorants = MajorantGrid(medium);
    if (!medium.albedo_volume)
        info.integrable = dynamic_cast<const IntegrableVolume*>(medium.sigma_t_volume.get());
    std::vector<std::uint32_t> boundary;
    Box3f bounds;
    bool refracts_everywhere = true, even = true;
    float eta = 0.f, spread = 0.f;
    for (std::uint32_t i = 0; i < scene_.shapes.size(); ++i) {
        const ShapeBinding& shape = scene_.shapes[i];
        // A medium on the outside of a shape, or around the camera, has no bounds that could be
        // known.
        if (shape.exterior == &medium) return;
        if (shape.interior != &medium) continue;
        boundary.push_back(i);
        bounds.extend(scene_.rays.bounds(i));
        refracts_everywhere &= !(shape.material->flags() & has_null);
        // All smooth or all rough, of one index.
        const bool rough = shape.material->rough_boundary_eta() > 1.f;
        const float this_eta =
            rough ? shape.material->rough_boundary_eta() : shape.material->smooth_boundary_eta();
        even &= this_eta > 1.f && !shape.exterior &&
                (eta == 0.f || (this_eta == eta && rough == (spread > 0.f)));
        eta = this_eta;
        if (rough) spread = std::max(spread, spread_of(*shape.material));
    }
    const Vec3f extent = bounds.diagonal();
    if (!boundary.empty()) info.size = std::min({extent.x, extent.y, extent.z});
    if (!boundary.empty() && !chains_.empty()) {
        // Light that is reflected inside has crossed the matter: what is left of it by then.
        const Vec3f sigma = medium.homogeneous() ? medium.sigma_t->rgb() : Vec3f{};
        const float crossed = std::min({sigma.x, sigma.y, sigma.z}) * medium.scale * info.size;
        info.chain_chance = most_chain_chance * std::exp(-0.5f * crossed);
    }
    if (boundary.empty() || scene_.camera_medium == &medium) return;

    info.connect =
        !refracts_everywhere || std::ranges::any_of(scene_.lights, [&](const LightPtr& light) {
            return !light->bounds().empty() && overlap(light->bounds(), bounds);
        });
    // Exits are guided from the grid's cells, whether or not its distances save rays.
    const bool guided = scene_.integrator.guided_exits && even && !info.connect;
    if (!medium.homogeneous() || !(scene_.integrator.distance_grid || guided)) return;
    // Where nothing is scattered, paths do not collide.
    const Vec3f sigma_t = medium.sigma_t->rgb(), albedo = medium.albedo->rgb();
    float thickest = 0.f;
    for (std::size_t c = 0; c < 3; ++c)
        if (albedo[c] > 0.f) thickest = std::max(thickest, sigma_t[c] * medium.scale);
    if (!(thickest > 0.f)) return;
    info.grid =
        DistanceGrid(scene_.rays, bounds, cell_in_free_paths / thickest, max_grid_cells, work);
    if (guided) info.guide = ExitGuide(scene_, medium, boundary, eta, spread, info.grid, work);
    if (!scene_.integrator.distance_grid) info.grid.forget_distances();
}

Spectral VolumePathTracer::radiance(const Ray& ray, Sampler& sampler,
                                    const Wavelengths& wavelengths, RayCounts& counts) const {
    return VolumePath(*this, ray, sampler, wavelengths, counts).trace();
}

}  // namespace nacre
