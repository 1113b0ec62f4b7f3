// Rays aimed at the corners and sides of a closed surface, where hits get lost, and the proof that one has to hit it.
#pragma once

#include <array>
#include <vector>

#include <espalier/ray.hpp>
#include <runtime/lattice/round_ray.hpp>

#include "support/base/random.hpp"
#include "support/blobs/extreme_shapes.hpp"

namespace espalier::tests {

enum class Aim { from_inside, from_outside, far, axis_parallel, grazing, count };

/// From 2^-20 sizes away ("far": 100 to 10^7 sizes) through a corner, the middle of a side or any point of one, a few
/// ulp beside it in half of the rays; "grazing" along a face, 10^-7 to 10^-3 of the size below it. Directions are of
/// any length, subnormal and nearly infinite ones too; windows end or begin inside, are as large as floats or endless.
class AimedRays {
public:
    AimedRays(const ExtremeSolid& solid, std::uint64_t seed);

    Ray ray(Aim aim);
    /// No ray of use: zero, NaN or infinite where that is not allowed.
    Ray hostile_ray();

private:
    using Point = std::array<double, 3>;

    Point inside();
    Point on_side(const GridTriangle& triangle);
    const GridTriangle& face();
    float nudged(float value);
    [[nodiscard]] Vec3 to_world(const Point& steps) const;
    void set_length_and_window(Ray& ray);

    const ExtremeSolid& solid_;
    Random random_;
    double step_;
    double size_;  ///< of the surface, in steps
};

/// What a ray has to do for it to hit the surface, whatever the triangles on its way: to be inside, behind every face,
/// and to have an end of its window outside. In double, with margins that are far above its errors.
class HitProof {
public:
    explicit HitProof(const ExtremeSolid& solid);

    enum class Crossing { unproved, enters, leaves };
    /// Of the ray as it was rounded.
    [[nodiscard]] Crossing crossing(const detail::LatticeRay& ray) const;

    /// Whether the ray, as the caller gave it, goes so deep into the surface that no rounding may make it pass by.
    [[nodiscard]] bool must_not_pass_by(const Ray& ray) const;

private:
    using Point = std::array<double, 3>;

    struct Face {
        Point normal;  ///< outward
        double offset;
        double width;  ///< of a step, along the normal
    };
    struct Stretch {
        double from;
        double to;
    };

    /// Of the line, what is behind every face by the margin, in lattice steps.
    [[nodiscard]] Stretch inside(const Point& origin, const Point& direction, double margin) const;
    [[nodiscard]] bool is_outside(const Point& point) const;

    std::vector<Face> faces_;
    Point low_, high_;
    Point world_origin_;
    double step_;
};

}  // namespace espalier::tests
