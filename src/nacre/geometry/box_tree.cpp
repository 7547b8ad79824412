#include "nacre/geometry/box_tree.h"

#include <algorithm>

#include "nacre/geometry/embree.h"
#include "nacre/math/error.h"

namespace nacre {

struct BoxTree::Impl {
    std::vector<Box3f> boxes;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void check() const {
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
            throw RunError("not enough memory for a tree of boxes");
    }
};

BoxTree::BoxTree() = default;
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

BoxTree::BoxTree(std::vector<Box3f> boxes) {
    if (boxes.empty()) return;
    impl_ = std::make_unique<Impl>();
    impl_->boxes = std::move(boxes);
    impl_->device = rtcNewDevice(nullptr);
    if (!impl_->device) throw RunError("Embree could not start a device");
    impl_->scene = rtcNewScene(impl_->device);
    const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(impl_->boxes.size()));
    rtcSetGeometryUserData(geometry, impl_->boxes.data());
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* args) {
            const Box3f& b = static_cast<const Box3f*>(args->geometryUserPtr)[args->primID];
            *args->bounds_o = {b.lower.x, b.lower.y, b.lower.z, 0.f,
                               b.upper.x, b.upper.y, b.upper.z, 0.f};
        },
        nullptr);
    // Every node on the way to a leaf is visited by its box alone: the better tree pays.
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(impl_->scene);
    impl_->check();
}

std::size_t BoxTree::size() const { return impl_ ? impl_->boxes.size() : 0; }

void BoxTree::holding(const Point3f& p, std::vector<std::uint32_t>& found) const {
    found.clear();
    if (!impl_) return;
    struct Search {
        const std::vector<Box3f>& boxes;
        Point3f p;
        std::vector<std::uint32_t>& found;

        static bool visit(RTCPointQueryFunctionArguments* args) {
            const auto& self = *static_cast<Search*>(args->userPtr);
            const Box3f& b = self.boxes[args->primID];
            const Point3f& p = self.p;
            if (p.x >= b.lower.x && p.x <= b.upper.x && p.y >= b.lower.y && p.y <= b.upper.y &&
                p.z >= b.lower.z && p.z <= b.upper.z)
                self.found.push_back(args->primID);
            return false;
        }
    };
    Search search{impl_->boxes, p, found};
    RTCPointQuery query;
    query.x = p.x;
    query.y = p.y;
    query.z = p.z;
    query.time = 0.f;
    query.radius = 0.f;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(impl_->scene, &query, &context, &Search::visit, &search);
    std::ranges::sort(found);
}

}  // namespace nacre
