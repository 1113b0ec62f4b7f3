// What a picture shows, a blob or a scene, and a pinhole eye that stands so that it just fills the picture.
#pragma once

#include <functional>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/scene.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include "base/placement.hpp"
#include "files/blob_file.hpp"

namespace espalier::tools {

/// The surface of a file, which rays meet. The file must outlive it. Any number of threads may call one.
class Subject {
public:
    explicit Subject(const AssetFile& file) : file_(file) {}

    [[nodiscard]] RayHit closest_hit(const Ray& ray) const;
    [[nodiscard]] bool is_hit(const Ray& ray) const;
    /// Returns a box around the surface; its middle is in the middle of the picture, about.
    [[nodiscard]] Box bounds() const { return file_.is_a_scene ? file_.scene().bounds() : file_.blob.bounds(); }
    /// Returns the lattice step, the largest one if there are several.
    [[nodiscard]] float step() const;
    /// Calls `visit` with points whose hull contains the surface.
    void for_each_corner(const std::function<void(Vec3)>& visit) const;

private:
    const AssetFile& file_;
};

Vec3 operator+(Vec3 a, Vec3 b);
Vec3 operator-(Vec3 a, Vec3 b);
Vec3 operator*(float factor, Vec3 a);
float dot(Vec3 a, Vec3 b);
Vec3 cross(Vec3 a, Vec3 b);
Vec3 normalized(Vec3 a);

/// Right, up and towards the eye: unit vectors at right angles.
struct View {
    Vec3 right;
    Vec3 up;
    Vec3 towards;
};

/// Seen from `azimuth` degrees around the up axis and `elevation` degrees above the horizon.
View view_from(Axis up, double azimuth, double elevation);

class Camera {
public:
    /// Stands as near as shows every corner, with the subject in the middle of the picture.
    Camera(const Subject& subject, const View& view, unsigned width, unsigned height);
    /// Through the picture at column and row, which count pixels from the top left and may lie between them.
    [[nodiscard]] Ray ray(float column, float row) const;
    [[nodiscard]] const View& view() const { return view_; }

private:
    View view_;
    Vec3 eye_;
    float half_width_;  // of the picture, at distance 1
    float half_height_;
    float width_;
    float height_;
};

}  // namespace espalier::tools
