#include "nacre/realtime/frame_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nacre/geometry/transform.h"
#include "nacre/math/error.h"
#include "nacre/spectrum/color.h"

namespace nacre {

/// A translucent shape and its technique.
struct FrameRenderer::Part {
    std::uint32_t part;  // of GpuScene::shapes
    ObjectBoundary boundary;
    std::unique_ptr<RealtimeTechnique> technique;
};

namespace {

constexpr int transmittance_steps = 256;

Mat4 inverse_of(const Mat4& m) {
    Transform::Matrix rows;
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) rows[4 * r + c] = m[4 * c + r];
    const Transform::Matrix inverse = Transform(rows).inverse().matrix();
    Mat4 result;
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) result[4 * c + r] = float(inverse[4 * r + c]);
    return result;
}

int levels_of(int size) { return int(std::bit_width(unsigned(size))); }

/// The uniforms of emission.glsl.
void set_light(ComputePass& pass, const LightPoint& p, const Point3f& middle) {
    const bool lamp = length_squared(p.normal) > 0.f;
    const Vec3f away = middle - p.position;
    pass.set("light_position", p.position)
        .set("light_normal", p.normal)
        .set("light_color", p.color)
        .set("light_distance2", p.distance2)
        .set("light_cosine", lamp ? dot(p.normal, away) / length(away) : 0.f)
        .set("light_parallel", int(p.parallel));
}

}  // namespace

float RealtimeInput::exit_scale() const {
    const auto& parameters = options.parameters();
    const bool paper =
        std::ranges::find(parameters, "exit_fresnel", &Parameter::name) != parameters.end() &&
        options.word("exit_fresnel") == "paper";
    return float(1. / (std::numbers::pi * (paper ? 1. : boundary.mean_transmittance())));
}

FrameRenderer::FrameRenderer(Gpu& gpu, const Scene& scene, std::vector<ShapeTechnique> shapes,
                             const Work& work)
    : gpu_(gpu), techniques_(std::move(shapes)), scene_(gpu, scene, techniques_, work) {
    make_parts(work);
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::changed(const Changes& what, const Work& work) {
    if (what.within({.view = true})) return;
    if (what.light) falloffs_.clear();
    scene_.changed(what, work);
    // Techniques in real time precompute little; what they do hangs on all of these but the light.
    if (!what.within({.view = true, .light = true})) make_parts(work);
}

void FrameRenderer::set_techniques(std::vector<ShapeTechnique> shapes, const Work& work) {
    techniques_ = std::move(shapes);
    make_parts(work);
}

void FrameRenderer::make_parts(const Work& work) {
    parts_.clear();
    std::vector<float> table;
    for (std::uint32_t i = 0; i < scene_.shapes().size(); ++i) {
        const GpuShape& s = scene_.shapes()[i];
        if (s.kind != GpuShapeKind::translucent) break;  // they come first
        const ShapeTechnique& technique = techniques_[s.shape];
        try {
            auto part = std::make_unique<Part>(
                Part{i, ObjectBoundary::of(scene_.scene().shapes[s.shape]), nullptr});
            part->technique = technique.technique->realtime(
                {gpu_, scene_, i, technique.options, technique.profile, part->boundary, work});
            for (int k = 0; k < transmittance_steps; ++k)
                table.push_back(part->boundary.transmittance(float(k) / (transmittance_steps - 1)));
            parts_.push_back(std::move(part));
        } catch (const InputError& error) {
            throw InputError(technique.place + error.what());
        }
    }
    const int rows = std::max(1, int(parts_.size()));
    table.resize(std::size_t(rows) * transmittance_steps, 1.f);
    transmittance_ = Texture(TexelFormat::r32f, transmittance_steps, rows);
    transmittance_.upload(table);
}

void FrameRenderer::resize(const View& view, int light_view) {
    const auto fit = [](Texture& t, int width, int height, int levels) {
        if (!t.is(width, height)) t = Texture(TexelFormat::rgba32f, width, height, levels);
    };
    for (Texture* t : {&position_, &normal_, &lit_image_, &below_, &frame_})
        fit(*t, view.width, view.height, 1);
    for (Texture* t : {&light_position_, &light_entered_}) {
        fit(*t, light_view, light_view, levels_of(light_view));
        t->end_at_edge();
    }
}

void FrameRenderer::see(const View& view) {
    camera_.see(gpu_, scene_, scene_.triangles(), view, visibility_, "camera visibility");
    gpu_.compute("camera surface", gpu_.program("attributes.glsl"))
        .reads(0, scene_.positions())
        .reads(1, scene_.indices())
        .reads(2, scene_.normals())
        .reads_image(0, camera_.ids())
        .writes(1, position_)
        .writes(2, normal_)
        .writes(3, lit_image_)
        .writes(4, below_)
        .set("clip", view.clip)
        .set("eye", view.eye)
        .set("is_parallel", int(view.parallel))
        .set("translucent_parts", int(parts_.size()))
        .threads(view.width, view.height);
}

std::vector<LightPoint> FrameRenderer::lights_at(const Point3f& middle,
                                                 const FrameOptions& options) {
    std::vector<LightPoint> points =
        light_points(scene_.scene(), middle, options.light_points, options.index);
    for (LightPoint& p : points) {
        if (!p.light->is_delta() || p.parallel) continue;
        const auto [found, is_new] = falloffs_.try_emplace(p.light);
        Falloff& falloff = found->second;
        if (is_new) {
            falloff.shape = shape_of(*p.light);
            if (!falloff.shape.even) {
                falloff.texture = Texture(TexelFormat::r32f, LightShape::width, LightShape::height);
                falloff.texture.upload(falloff.shape.falloff);
            }
        }
        p.color = falloff.shape.peak * (1.f / p.distance2);
    }
    return points;
}

void FrameRenderer::light(const CameraSurface& camera, Part& part, const LightPoint& point,
                          const FrameOptions& options, bool first, bool last) {
    const GpuShape& shape = scene_.shapes()[part.part];
    const Point3f middle = shape.bounds.center();
    const float radius = shape.radius * 1.01f;
    const View view = point.parallel
                          ? parallel_view(point.position, middle, radius, options.light_view)
                          : light_view(point.position, middle, radius, options.light_view);
    lit_.see(gpu_, scene_, scene_.occluders(), view, visibility_, "light visibility");
    const auto found = falloffs_.find(point.light);
    const bool has_falloff = found != falloffs_.end() && !found->second.shape.even;
    const Texture& falloff = has_falloff ? found->second.texture : transmittance_;
    auto surface = gpu_.compute("light surface", gpu_.program("light_view.glsl"));
    set_light(surface, point, middle);
    surface.reads(0, scene_.positions())
        .reads(1, scene_.indices())
        .reads(2, scene_.normals())
        .reads(4, scene_.materials())
        .reads_image(0, lit_.ids())
        .writes(1, light_position_)
        .writes(2, light_entered_)
        .reads(0, transmittance_)
        .reads(1, falloff)
        .set("has_falloff", int(has_falloff))
        .set("clip", view.clip)
        .set("part", int(part.part))
        .set("pixel_width", view.pixel)
        .threads(view.width, view.height);
    for (int level = 1; level < light_position_.levels(); ++level)
        gpu_.compute("light levels", gpu_.program("light_mip.glsl"))
            .reads_image(0, light_position_, level - 1)
            .reads_image(1, light_entered_, level - 1)
            .writes(2, light_position_, level)
            .writes(3, light_entered_, level)
            .threads(view.width >> level, view.height >> level);
    auto lit = gpu_.compute("lit", gpu_.program("lit.glsl"));
    set_light(lit, point, middle);
    lit.reads(4, scene_.materials())
        .writes(0, lit_image_)
        .reads(0, position_)
        .reads(1, normal_)
        .reads(2, lit_.depth())
        .reads(3, transmittance_)
        .reads(4, falloff)
        .set("has_falloff", int(has_falloff))
        .set("light_clip", view.clip)
        .set("part", int(part.part))
        .set("first_part", int(first))
        .set("last_part", int(last))
        .set("pixel_width", view.pixel)
        .set("depth_range", view.depth_range)
        .threads(camera.view.width, camera.view.height);
    part.technique->add_light(camera, {view, point, light_position_, light_entered_, lit_.depth()},
                              below_);
}

void FrameRenderer::compose(const View& view) {
    gpu_.compute("compose", gpu_.program("compose.glsl"))
        .reads(4, scene_.materials())
        .writes(0, frame_)
        .reads(0, position_)
        .reads(1, normal_)
        .reads(2, lit_image_)
        .reads(3, below_)
        .reads(4, transmittance_)
        .reads(5, scene_.surroundings())
        .reads(6, scene_.background())
        .set("from_clip", view.parallel ? view.clip : inverse_of(view.clip))
        .set("eye", view.eye)
        .set("is_parallel", int(view.parallel))
        .threads(view.width, view.height);
}

const Texture& FrameRenderer::render(const View& view, const FrameOptions& options) {
    resize(view, options.light_view);
    see(view);
    const CameraSurface camera{view, position_, normal_, lit_image_, options.index};
    if (!parts_.empty()) {
        Box3f box;
        for (const auto& part : parts_) box.extend(scene_.shapes()[part->part].bounds);
        for (const LightPoint& point : lights_at(box.center(), options))
            for (const auto& part : parts_)
                light(camera, *part, point, options, part == parts_.front(), part == parts_.back());
        for (const auto& part : parts_) part->technique->finish(camera, below_);
    }
    compose(view);
    gpu_.check_errors();
    return frame_;
}

std::size_t FrameRenderer::bytes() const {
    std::size_t sum = scene_.bytes() + camera_.bytes() + lit_.bytes();
    for (const Texture* t : {&position_, &normal_, &lit_image_, &below_, &frame_, &transmittance_,
                             &light_position_, &light_entered_})
        sum += t->bytes();
    for (const auto& part : parts_) sum += part->technique->bytes();
    return sum;
}

}  // namespace nacre
