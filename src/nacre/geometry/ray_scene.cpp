#include "nacre/geometry/ray_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "nacre/geometry/closest_point.h"
#include "nacre/geometry/ray_scene_impl.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

// Above this many triangles the acceleration structure refers to the mesh's vertices instead of
// holding copies of them.
constexpr std::size_t kCompactAbove = 4'000'000;

const AnalyticShape& shape_of(void* user_pointer) {
    return *static_cast<const AnalyticShape*>(user_pointer);
}

void bound_analytic(const RTCBoundsFunctionArguments* args) {
    const Box3f box = shape_of(args->geometryUserPtr).bounds();
    *args->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0.f,
                       box.upper.x, box.upper.y, box.upper.z, 0.f};
}

bool meets(const RTCRay& ray, void* user_pointer, AnalyticHit& hit) {
    if (!shape_of(user_pointer)
             .intersect({ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z},
                        ray.tnear, ray.tfar, hit))
        return false;
    // The parameter must stay inside the open interval when it is rounded to float, too.
    return static_cast<float>(hit.t) > ray.tnear;
}

// Both callbacks are only ever called for single rays: no packet query is used.
void intersect_analytic(const RTCIntersectFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
    AnalyticHit hit;
    if (!meets(query.ray, args->geometryUserPtr, hit)) return;
    query.ray.tfar = static_cast<float>(hit.t);
    query.hit.u = hit.u;
    query.hit.v = hit.v;
    query.hit.geomID = args->geomID;
    query.hit.primID = args->primID;
}

void occlude_analytic(const RTCOccludedFunctionNArguments* args) {
    if (args->valid[0] == 0) return;
    auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
    AnalyticHit hit;
    if (meets(ray, args->geometryUserPtr, hit)) ray.tfar = -std::numeric_limits<float>::infinity();
}

void set_ray(const Ray& from, RTCRay& to) {
    to.org_x = from.o.x;
    to.org_y = from.o.y;
    to.org_z = from.o.z;
    to.tnear = from.tmin;
    to.dir_x = from.d.x;
    to.dir_y = from.d.y;
    to.dir_z = from.d.z;
    to.time = 0.f;
    to.tfar = from.tmax;
    to.mask = ~0u;
    to.id = 0;
    to.flags = 0;
}

void check_mesh(const Mesh& mesh) {
    const std::string name = mesh.name.empty() ? "mesh" : mesh.name;
    const std::size_t n = mesh.positions.size();
    if (mesh.triangles.empty())
        throw InputError(name + ": has no triangles; a shape needs at least one");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            if (corner >= n)
                throw InputError(fmt::format(
                    "{}: triangle {} names vertex {} but there are {} vertices (counted from 0)",
                    name, i, corner, n));
    if ((!mesh.normals.empty() && mesh.normals.size() != n) ||
        (!mesh.uvs.empty() && mesh.uvs.size() != n))
        throw InputError(fmt::format(
            "{}: has {} positions, {} normals, {} uvs; give one normal and uv a position, or none",
            name, n, mesh.normals.size(), mesh.uvs.size()));
}

}  // namespace

RayScene::Impl::Impl() : device(rtcNewDevice(nullptr)) {
    if (!device) throw RunError("Embree could not start a device");
    scene = rtcNewScene(device);
    // Robust: edges of closed meshes have no cracks, which a random walk would find.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitScene(scene);  // queries of an empty scene are answered, too
    check();
}

RayScene::Impl::~Impl() {
    if (scene) rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

void RayScene::Impl::check() const {
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        throw RunError(error == RTC_ERROR_OUT_OF_MEMORY
                           ? std::string("not enough memory for the acceleration structure")
                           : fmt::format("Embree failed with error {}", static_cast<int>(error)));
}

std::uint32_t RayScene::Impl::attach(RTCGeometry geometry, std::unique_ptr<Shape> shape) {
    rtcCommitGeometry(geometry);
    const auto id = static_cast<std::uint32_t>(shapes.size());
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
    check();
    bounds.extend(shape->bounds);
    shapes.push_back(std::move(shape));
    return id;
}

RayScene::RayScene() : impl_(std::make_unique<Impl>()) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::uint32_t RayScene::add(std::shared_ptr<const Mesh> mesh, bool face_normals,
                            bool flip_normals) {
    check_mesh(*mesh);
    auto shape = std::make_unique<Impl::Shape>();
    shape->face_normals = face_normals;
    shape->flip_normals = flip_normals;
    shape->bounds = mesh->bounds();
    const std::vector<Point3f>* positions = &mesh->positions;
    if (positions->capacity() == positions->size()) {
        shape->padded.reserve(positions->size() + 1);
        shape->padded = *positions;
        positions = &shape->padded;
    }
    const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions->data(), 0, sizeof(Point3f), positions->size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh->triangles.data(), 0, sizeof(Mesh::Triangle),
                               mesh->triangles.size());
    impl_->triangles += mesh->triangles.size();
    shape->mesh = std::move(mesh);
    return impl_->attach(geometry, std::move(shape));
}

std::uint32_t RayScene::add(const Primitive& primitive) {
    auto shape = std::make_unique<Impl::Shape>();
    shape->analytic = std::make_unique<AnalyticShape>(primitive);
    shape->primitive = primitive;
    shape->bounds = shape->analytic->bounds();
    const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, shape->analytic.get());
    rtcSetGeometryBoundsFunction(geometry, bound_analytic, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_analytic);
    rtcSetGeometryOccludedFunction(geometry, occlude_analytic);
    return impl_->attach(geometry, std::move(shape));
}

void RayScene::build() {
    const bool compact = impl_->triangles > kCompactAbove;
    rtcSetSceneFlags(impl_->scene, static_cast<RTCSceneFlags>(
                                       RTC_SCENE_FLAG_ROBUST |
                                       (compact ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE)));
    rtcCommitScene(impl_->scene);
    impl_->check();
}

std::optional<Hit> RayScene::intersect(const Ray& ray) const {
    RTCRayHit query;
    set_ray(ray, query.ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(impl_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
}

bool RayScene::occluded(const Ray& ray) const {
    RTCRay query;
    set_ray(ray, query);
    embree::occluded(impl_->scene, query);
    return query.tfar < 0.f;
}

std::optional<Hit> RayScene::closest(const Point3f& p, float limit,
                                     std::optional<std::uint32_t> shape, float tolerance) const {
    struct Search {
        const std::vector<std::unique_ptr<Impl::Shape>>& shapes;
        std::optional<std::uint32_t> only;
        Vec3d p;
        double nearest;
        float keep;  // part of the distance found within which the search goes on
        std::optional<Hit> hit;

        static bool visit(RTCPointQueryFunctionArguments* args) {
            auto& self = *static_cast<Search*>(args->userPtr);
            if (self.only && *self.only != args->geomID) return false;
            const Impl::Shape& candidate = *self.shapes[args->geomID];
            AnalyticHit found;
            if (candidate.mesh) {
                const Mesh& mesh = *candidate.mesh;
                const Mesh::Triangle& t = mesh.triangles[args->primID];
                found =
                    closest_on_triangle(self.p, Vec3d(mesh.positions[t[0]]),
                                        Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]));
            } else {
                found = candidate.analytic->closest(self.p);
            }
            if (!(found.t < self.nearest)) return false;
            self.nearest = found.t;
            self.hit =
                Hit{static_cast<float>(found.t), args->geomID, args->primID, found.u, found.v};
            // Rounded up, so that nothing nearer is culled.
            args->query->radius = static_cast<float>(found.t) * self.keep;
            return true;
        }
    };
    // No point is farther than the far corner of the bounds; this also keeps the square of the
    // radius, which Embree computes, finite.
    const Box3f box = shape ? impl_->shapes.at(*shape)->bounds : impl_->bounds;
    if (box.empty()) return std::nullopt;
    const Vec3d far{
        std::max(std::abs(double(p.x) - box.lower.x), std::abs(double(p.x) - box.upper.x)),
        std::max(std::abs(double(p.y) - box.lower.y), std::abs(double(p.y) - box.upper.y)),
        std::max(std::abs(double(p.z) - box.lower.z), std::abs(double(p.z) - box.upper.z))};
    Search search{impl_->shapes, shape, Vec3d(p), limit, (1 + 0x1p-22f) * (1 - tolerance),
                  std::nullopt};
    RTCPointQuery query;
    query.x = p.x;
    query.y = p.y;
    query.z = p.z;
    query.time = 0.f;
    query.radius = std::min(limit, static_cast<float>(length(far)) * 1.0001f);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(impl_->scene, &query, &context, &Search::visit, &search);
    return search.hit;
}

float RayScene::distance(const Point3f& p, float limit, std::optional<std::uint32_t> shape,
                         float tolerance) const {
    const std::optional<Hit> hit = closest(p, limit, shape, tolerance);
    return hit ? std::min(hit->t, limit) : limit;
}

SurfacePoint RayScene::surface_point(const Ray&, const Hit& hit) const {
    SurfacePoint point = impl_->shapes[hit.shape]->surface(hit.primitive, hit.u, hit.v);
    point.shape = hit.shape;
    point.primitive = hit.primitive;
    return point;
}

std::size_t RayScene::shape_count() const { return impl_->shapes.size(); }
Box3f RayScene::bounds() const { return impl_->bounds; }
Box3f RayScene::bounds(std::uint32_t shape) const { return impl_->shapes.at(shape)->bounds; }
const Primitive* RayScene::primitive(std::uint32_t shape) const {
    const auto& primitive = impl_->shapes.at(shape)->primitive;
    return primitive ? &*primitive : nullptr;
}
const Mesh* RayScene::mesh(std::uint32_t shape) const {
    return impl_->shapes.at(shape)->mesh.get();
}

}  // namespace nacre
