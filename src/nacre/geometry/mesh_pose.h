#pragma once
// How an object in a mesh file stands, which files do not say: up and front, of those along the
// file's axes.
#include <optional>
#include <string>
#include <string_view>

#include "nacre/geometry/mesh.h"

namespace nacre {

/// A direction along an axis of a file.
struct SignedAxis {
    int axis = 1;  ///< 0, 1, 2: x, y, z
    int sign = 1;  ///< or -1

    friend bool operator==(const SignedAxis&, const SignedAxis&) = default;
};
/// "+z", "-y".
std::string name_of(SignedAxis direction);
/// "z", "+z" or "-z", in any case; nothing for other words.
std::optional<SignedAxis> find_signed_axis(std::string_view word);

/// What is up and where the front looks: perpendicular to each other.
struct MeshPose {
    SignedAxis up{1, 1}, front{2, 1};
    bool up_by_shape = false, front_by_shape = false;  ///< else by custom

    friend bool operator==(const MeshPose&, const MeshPose&) = default;
    bool is_identity() const { return up == SignedAxis{1, 1} && front == SignedAxis{2, 1}; }
    /// A point or vector of the file with up along +y and the front along +z. Exact.
    Vec3f turn(const Vec3f& v) const;
};

/// The front that goes with an up by custom: +z with +y (glTF), -y with +z (Blender, CAD); turned
/// over about x with those that look down, and +z with x.
SignedAxis usual_front(SignedAxis up);

/// A guess from the shape; `usual_up` is kept where that says nothing.
///
/// Up: a shape stands on what carries it. Its base in a direction is the convex hull of what lies
/// within a hundredth of its size above its lowest point. It is firm if that is at least a fifth of
/// the whole's outline seen from above and the middle of the surface is well above it. The usual up
/// is kept unless its base is infirm or less than 3/10 of the best firm one.
///
/// Front: heads and animals are mirror images of themselves, and their upper half has more detail
/// in front than behind: in curvature by area, of the quarter that looks either way. It has to be
/// 1.6 times as much for the usual front to be given up. Where the mirror is across the usual front,
/// the object shows its profile, and twice as much detail on one side turns that to the front.
MeshPose guess_pose(const Mesh& mesh, SignedAxis usual_up, std::optional<SignedAxis> given_up = {});

}  // namespace nacre
