// What a picture shows, where its eye stands, and what its pixels look like: linear light in, PNG out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/scene.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

#include <import/base/placement.hpp>

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
