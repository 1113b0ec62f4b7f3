// A pinhole eye that stands so that an asset just fills the picture.
#pragma once

#include <espalier/ray.hpp>
#include <espalier/types.hpp>

#include "base/placement.hpp"
#include "subject.hpp"

namespace espalier::tools {

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
