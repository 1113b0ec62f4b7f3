// What a pixel looks like.
#pragma once

#include <espalier/ray.hpp>

#include "camera.hpp"
#include "image.hpp"
#include "subject.hpp"

namespace espalier::tools {

/// Two lights that stand with the eye, the stronger one casting shadows, over a gradient.
class Shading {
public:
    Shading(const Subject& subject, const View& view, Vec3 world_up);
    /// Returns the colour where the ray ends; it passes the picture at `height`, 0 at the bottom, 1 at the top.
    [[nodiscard]] Colour colour(const Ray& ray, float height) const;
    [[nodiscard]] static Colour background(float height);

private:
    [[nodiscard]] bool in_shadow(Vec3 point, Vec3 normal) const;

    const Subject& subject_;
    Vec3 world_up_;
    Vec3 main_light_;
    Vec3 side_light_;
    float shadow_offset_;
};

/// 0 black over blue, red and yellow to 1 white; brightness rises all the way, so that it also reads in grey.
Colour heat_colour(float heat);

}  // namespace espalier::tools
