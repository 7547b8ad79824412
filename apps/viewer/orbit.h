#pragma once
// From where the viewer looks: a camera that turns about a point of the object.
#include "nacre/scene/scene.h"
#include "nacre/scene/stage.h"
#include "nacre/scene/xml/scene_node.h"

namespace nacre::viewer {

/// Directions as people name them: degrees from the front towards the right, and above the floor.
struct Compass {
    Vec3d up{0, 1, 0}, front{0, 0, 1};

    Vec3d right() const { return cross(up, front); }
    Vec3d direction(double azimuth, double elevation) const;
    /// Azimuth and elevation of a direction of any length.
    std::pair<double, double> angles(const Vec3d& direction) const;
    /// The axis of space next to the way that is up in a picture.
    static Compass of(const Vec3d& up_in_picture);
};

class OrbitCamera {
  public:
    OrbitCamera() = default;
    /// As the scene's own camera looks at the middle of what is in it.
    OrbitCamera(const Scene& scene, const Box3f& object);

    /// Degrees by which the viewer walks to the right, and up; never over the top.
    void turn(double right, double up);
    /// Shares of the picture's height by which the object moves to the right and up.
    void pan(double right, double up);
    /// The distance times `factor`.
    void zoom(double factor);
    /// The object's middle from there, at the same distance.
    void look_from(const StageView& view);

    const Compass& compass() const { return compass_; }
    Vec3d eye() const { return target_ + offset_; }
    Vec3d middle() const { return middle_; }
    /// The <sensor> that looks so: the scene's own one as long as nobody moved.
    SceneNodePtr sensor() const;
    /// Throws InputError as make_camera does.
    CameraPtr camera(double aspect) const;
    bool operator==(const OrbitCamera& o) const {
        return moved_ == o.moved_ && target_ == o.target_ && offset_ == o.offset_ && up_ == o.up_ &&
               scale_ == o.scale_;
    }

  private:
    SceneNodePtr own_;
    bool parallel_ = false, moved_ = false;
    Compass compass_;
    Vec3d target_{0, 0, 0}, offset_{0, 0, 1}, up_{0, 1, 0}, middle_{0, 0, 0};
    double scale_ = 1;            // half the width of what an orthographic camera sees
    double height_per_unit_ = 1;  // of the picture, at distance 1 or of scale 1
};

}  // namespace nacre::viewer
