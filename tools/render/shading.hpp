// What pixels look like, and pictures of them: linear light in, PNG out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <espalier/ray.hpp>

#include "camera.hpp"

namespace espalier::tools {

/// Linear light, 0 black to 1 white.
struct Colour {
    float red = 0.0f;
    float green = 0.0f;
    float blue = 0.0f;
};

Colour operator+(Colour a, Colour b);
Colour operator*(float factor, Colour colour);
Colour mix(Colour a, Colour b, float share_of_b);

class Image {
public:
    Image(unsigned width, unsigned height);
    [[nodiscard]] unsigned width() const { return width_; }
    [[nodiscard]] unsigned height() const { return height_; }
    /// Row 0 is the top. Different pixels may be set from different threads.
    void set(unsigned column, unsigned row, Colour colour);
    /// The bytes of a PNG file, 8 bits a channel, sRGB. Throws CommandError (internal), and (unsupported) in a build
    /// without libpng.
    [[nodiscard]] std::vector<std::byte> png() const;

private:
    unsigned width_;
    unsigned height_;
    std::vector<std::uint8_t> pixels_;
};

/// Calls `row` once for each number below `rows`, from several threads, in no order; `done`, from this thread only,
/// with the share that is begun. `threads` 0 takes as many as the machine has.
void for_each_row(unsigned rows, unsigned threads, const std::function<void(unsigned)>& row,
                  const std::function<void(double)>& done);

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
