#include "nacre/techniques/missing_light.h"

#include <fmt/format.h>

#include <algorithm>

#include "nacre/math/error.h"
#include "nacre/scene/subsurface.h"

namespace nacre {
namespace {

// A ray that looks for one shape meets at most so many others.
constexpr int most_other_surfaces = 64;

/// Whether `p` is inside of a shape, if that is closed.
bool is_inside(const Scene& scene, std::uint32_t shape, const Point3f& p) {
    const Vec3f d{0.36f, 0.48f, 0.8f};
    Ray ray{p, d};
    for (int i = 0; i < most_other_surfaces; ++i) {
        const auto hit = scene.rays.intersect(ray);
        if (!hit) return false;
        const SurfacePoint at = scene.rays.surface_point(ray, *hit);
        if (hit->shape == shape) return dot(at.ng, d) > 0.f;
        ray.o = at.spawn(d);
    }
    return false;
}

/// Whether some light that no path meets by chance lies outside of the shape.
bool is_lit_from_points(const Scene& scene, std::uint32_t shape) {
    return std::ranges::any_of(scene.lights, [&](const LightPtr& light) {
        if (!light->is_delta()) return false;
        const Box3f place = light->bounds();
        return place.empty() || !is_inside(scene, shape, place.center());
    });
}

/// Rough boundaries are connected to lights through one facet; smooth ones cannot be.
bool refracts_smoothly(const ShapeBinding& shape) {
    const unsigned flags = shape.material->flags();
    return (flags & transmits) && (flags & has_delta) && !(flags & has_null);
}

/// Simulation follows lights that no path meets through such boundaries (render/light_beams.h,
/// render/specular_chain.h).
bool lets_points_in(const ShapeBinding& shape) {
    return shape.material->smooth_boundary_eta() > 1.f;
}

/// "'a'", "'a' and 'b'", "'a', 'b' and 3 more".
std::string names_of(const Scene& scene, const std::vector<std::uint32_t>& shapes) {
    constexpr std::size_t most = 3;
    std::string text;
    const std::size_t shown = shapes.size() <= most ? shapes.size() : most - 1;
    for (std::size_t i = 0; i < shown; ++i) {
        const bool last = i + 1 == shapes.size();
        text += fmt::format("{}'{}'",
                            i == 0 ? ""
                            : last ? " and "
                                   : ", ",
                            scene.shapes[shapes[i]].name);
    }
    if (shown < shapes.size()) text += fmt::format(" and {} more", shapes.size() - shown);
    return text;
}

template <class F>
std::vector<std::uint32_t> shapes_where(const Scene& scene, F&& test) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i)
        if (test(i, scene.shapes[i])) found.push_back(i);
    return found;
}

std::string unseen_media(const Scene& scene, const RenderPlan& plan) {
    const std::vector<std::uint32_t> shapes =
        shapes_where(scene, [&](std::uint32_t i, const ShapeBinding& s) {
            const bool opaque = !(s.material->flags() & (transmits | has_null));
            return (s.interior || s.exterior) && !opaque && !plan.has_technique(i);
        });
    if (shapes.empty() && !scene.camera_medium) return "";
    const bool translucent = std::ranges::any_of(
        shapes, [&](std::uint32_t i) { return is_translucent(scene.shapes[i]); });
    return fmt::format(
        "integrator '{}' does not see the medium {}: the picture is as if it were not there; use "
        "--integrator volpath{}",
        plan.integrator, shapes.empty() ? "around the camera" : "at " + names_of(scene, shapes),
        translucent ? ", or a technique (--technique)" : "");
}

/// `plan`: null for complete simulation.
std::string unmet_lights(const Scene& scene, const RenderPlan* plan) {
    const bool any = std::ranges::any_of(scene.lights, &Light::is_delta);
    const std::vector<std::uint32_t> shapes =
        shapes_where(scene, [&](std::uint32_t i, const ShapeBinding& s) {
            if (!any || !refracts_smoothly(s) || (plan && plan->has_technique(i))) return false;
            if (!plan && lets_points_in(s)) return false;
            // Matter is lit from within; clear glass does not let a lamp inside shine out.
            return !(!plan && s.interior) || is_lit_from_points(scene, i);
        });
    if (shapes.empty()) return "";
    const bool translucent = std::ranges::any_of(
        shapes, [&](std::uint32_t i) { return is_translucent(scene.shapes[i]); });
    const bool simulated = plan && std::ranges::all_of(shapes, [&](std::uint32_t i) {
                               return lets_points_in(scene.shapes[i]);
                           });
    return fmt::format(
        "point, spot and directional lights do not shine through the smooth boundary of {}: no "
        "path meets them there, and what they would light inside and behind is dark; use small "
        "area lights{}{}",
        names_of(scene, shapes), simulated ? ", --integrator volpath" : "",
        translucent ? ", a rough boundary or a technique (--technique)" : "");
}

/// Mirrors throw such light onto others, too.
std::string unmet_reflections(const Scene& scene) {
    if (std::ranges::none_of(scene.lights, &Light::is_delta)) return "";
    const auto has = [](const ShapeBinding& s, unsigned flag) {
        return (s.material->flags() & flag) != 0;
    };
    const std::vector<std::uint32_t> mirrors =
        shapes_where(scene, [&](std::uint32_t, const ShapeBinding& s) {
            return has(s, has_delta) && !has(s, has_smooth | transmits | has_null);
        });
    const bool any_sees_it = std::ranges::any_of(scene.shapes, [&](const ShapeBinding& s) {
        return has(s, has_smooth) || s.interior || s.exterior;
    });
    if (mirrors.empty() || !(any_sees_it || scene.camera_medium)) return "";
    return fmt::format(
        "light of point, spot and directional lights that the mirror of {} throws onto what is "
        "around it is missing: no path meets them there; use small area lights",
        names_of(scene, mirrors));
}

/// What shared passes of frames do not carry.
std::string unseen_in_real_time(const Scene& scene, const RenderPlan& plan) {
    std::string text = "frames in real time leave out the light that one surface sends to another";
    const auto say = [&](const std::vector<std::uint32_t>& shapes, std::string_view what) {
        if (!shapes.empty()) text += fmt::format("; {} drawn {}", names_of(scene, shapes), what);
    };
    say(shapes_where(scene,
                     [&](std::uint32_t i, const ShapeBinding& s) {
                         return !plan.has_technique(i) && !s.light &&
                                (s.material->flags() & (transmits | has_null));
                     }),
        "as opaque");
    say(shapes_where(scene,
                     [&](std::uint32_t i, const ShapeBinding& s) {
                         return !plan.has_technique(i) && !s.light &&
                                !(s.material->flags() & (transmits | has_null)) &&
                                !s.material->is_lambertian();
                     }),
        "without highlights");
    if (scene.mode == ColorMode::spectral) text += "; wavelengths are those of red, green and blue";
    return text;
}

}  // namespace

std::vector<std::string> missing_in_simulation(const Scene& scene) {
    std::vector<std::string> result;
    for (std::string text : {unmet_lights(scene, nullptr), unmet_reflections(scene)})
        if (!text.empty()) result.push_back(std::move(text));
    return result;
}

std::vector<std::string> missing_light(const Scene& scene, const RenderPlan& plan) {
    if (plan.is_simulation()) return missing_in_simulation(scene);
    std::vector<std::string> result;
    const auto in_real_time = [](const ShapeTechnique& s) {
        return s.technique && s.technique->realtime;
    };
    if (std::ranges::any_of(plan.shapes, in_real_time)) return {unseen_in_real_time(scene, plan)};
    if (std::string text = unseen_media(scene, plan); !text.empty())
        result.push_back(std::move(text));
    // Recursive ray tracing and what came before it never had caustics.
    if (plan.integrator == "path")
        for (std::string text : {unmet_lights(scene, &plan), unmet_reflections(scene)})
            if (!text.empty()) result.push_back(std::move(text));
    return result;
}

std::vector<std::string> warnings_of(const Scene& scene, const RenderPlan& plan) {
    std::vector<std::string> result = scene.warnings;
    for (std::string& text : missing_light(scene, plan)) result.push_back(std::move(text));
    return result;
}

void require_lit_insides(const Scene& scene) {
    const std::vector<std::uint32_t> dark =
        shapes_where(scene, [&](std::uint32_t i, const ShapeBinding& s) {
            return s.interior && refracts_smoothly(s) && !lets_points_in(s) &&
                   is_lit_from_points(scene, i);
        });
    if (dark.empty()) return;
    throw InputError(
        fmt::format("complete simulation cannot be the reference: point, spot and directional "
                    "lights do not light the inside of {} through its smooth boundary, so the "
                    "truth would lack their light; use small area lights in their place, a rough "
                    "boundary, or another reference (--reference)",
                    names_of(scene, dark)));
}

}  // namespace nacre
