// Lower bounds of the time at which a moving sphere or capsule first touches triangles, in lanes. Seen from the sphere
// at the start of the axis, the triangle is swept backwards along the axis: a prism, or the triangle itself. What the
// sphere's centre comes near first is over a face, over an edge, or at a vertex of it (Ericson 2005, section 5.5.7).
// Each of these has a bound, and the least one is the triangle's.
#ifndef ESPALIER_SWEEPS_CAPSULE_BOUNDS_HPP
#define ESPALIER_SWEEPS_CAPSULE_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/leaf_bounds.hpp>

ESPALIER_BEGIN_SET

/// Lower bounds of the time at which a capsule touches the triangles of a leaf.
class CapsuleBounds {
public:
    using Beside = BesideWay;
    static int few(const FloatCapsule& capsule) { return capsule.is_sphere ? 1 : 2; }

    explicit CapsuleBounds(const FloatCapsule& capsule)
        : way_(splat_each(capsule.way)),
          axis_(splat_each(capsule.axis)),
          radius_(splat(capsule.radius)),
          squared_radius_(multiply(radius_, radius_)),
          way_length_(length_bound(way_)),
          squared_way_(dot(way_, way_)),
          is_sphere_(capsule.is_sphere) {}

    /// Returns a bound for each triangle, whose three corners are seen from the sphere's centre.
    [[nodiscard]] Floats operator()(const Floats3* corners) const {
        const Triangle triangle(corners);
        const Floats first = of_triangle(triangle, triangle.corners);
        return is_sphere_ ? first : smaller(first, of_prism(triangle));
    }

private:
    /// A triangle's sides, and its normal: what it and the same triangle at the other end of the axis share.
    struct Triangle {
        const Floats3* corners;
        Floats3 sides[3];
        Floats3 normal;
        Floats product;  ///< at least the length of the normal

        explicit Triangle(const Floats3* three)
            : corners(three),
              sides{subtract(three[1], three[0]), subtract(three[2], three[1]), subtract(three[0], three[2])},
              normal(cross(sides[0], sides[1])),
              product(multiply(length_bound(sides[0]), length_bound(sides[1]))) {}
    };

    [[nodiscard]] ESPALIER_NOINLINE Floats of_triangle(const Triangle& triangle, const Floats3* corners) const {
        Floats first = face(triangle, corners);
        for (int i = 0; i < 3; ++i) {
            first = smaller(first, edge(corners[i], triangle.sides[i]));
            first = smaller(first, vertex(corners[i]));
        }
        return first;
    }
    /// The rest of the prism: the triangle at the axis' other end, and what connects the two.
    [[nodiscard]] ESPALIER_NOINLINE Floats of_prism(const Triangle& triangle) const {
        const Floats3 back = negate(axis_);
        Floats3 moved[3];
        for (int i = 0; i < 3; ++i) moved[i] = subtract(triangle.corners[i], axis_);
        Floats first = smaller(of_triangle(triangle, moved), crossing(triangle));
        for (int i = 0; i < 3; ++i) {
            first = smaller(first, edge(triangle.corners[i], back));
            first = smaller(first, parallelogram(triangle.corners[i], triangle.sides[i], back));
        }
        return first;
    }

    [[nodiscard]] Floats vertex(const Floats3& p) const {
        using namespace time_bounds;
        const Floats squared = dot(p, p);
        const Floats b = multiply_add(multiply(length_bound(p), way_length_), splat(rounding), dot(p, way_));
        const Floats c =
            subtract(subtract(squared, squared_radius_), multiply(add(squared, squared_radius_), splat(rounding)));
        return root(multiply(squared_way_, splat(1.0f - rounding)), b, c);
    }
    /// Returns the bound for the cylinder around a side that begins at p, while the centre is beside it. A side without
    /// length is a vertex.
    [[nodiscard]] ESPALIER_NOINLINE Floats edge(const Floats3& p, const Floats3& side) const {
        using namespace time_bounds;
        const Floats squared = dot(side, side), length = length_bound(side), reach = length_bound(p);
        const Floats3 u = cross(p, side), v = cross(way_, side);
        const Floats a =
            larger(subtract(dot(v, v), multiply(multiply(squared_way_, squared), splat(rounding))), splat(0.0f));
        const Floats b = multiply_add(multiply(multiply(reach, way_length_), squared), splat(rounding), dot(u, v));
        const Floats c_error =
            multiply(multiply(multiply_add(reach, reach, squared_radius_), squared), splat(rounding));
        const Floats c = subtract(subtract(dot(u, u), multiply(squared_radius_, squared)), c_error);
        const Floats error = multiply(multiply(add(add(reach, way_length_), length), length), splat(rounding));
        const Interval beside = {negate(dot(p, side)), dot(way_, side), splat(0.0f), squared, error};
        const Floats when = larger(root(a, b, c), beside.entry());
        return where_at_most(squared, splat(0.0f), splat(never), larger(when, beside.is_left_at(when)));
    }
    /// Where the centre is over the face. A face without area is a side.
    [[nodiscard]] ESPALIER_NOINLINE Floats face(const Triangle& triangle, const Floats3* corners) const {
        using namespace time_bounds;
        const Floats reach = largest_of(length_bound(corners[0]), length_bound(corners[1]), length_bound(corners[2]));
        const Floats far = multiply(add(add(reach, way_length_), radius_), splat(rounding));
        const Floats squared = dot(triangle.normal, triangle.normal);
        const Interval plane = plane_of(triangle.normal, squared, corners[0], multiply(triangle.product, far));
        Floats when = plane.entry();
        Interval inside[3];
        for (int i = 0; i < 3; ++i) {
            const Floats3 inward = cross(triangle.normal, triangle.sides[i]);
            const Floats error = multiply(multiply(triangle.product, length_bound(triangle.sides[i])), far);
            inside[i] = {negate(dot(inward, corners[i])), dot(inward, way_), splat(0.0f), splat(never), error};
            when = larger(when, inside[i].entry());
        }
        Floats left = plane.is_left_at(when);
        for (const Interval& side : inside) left = larger(left, side.is_left_at(when));
        return where_at_most(squared, flat_below(triangle.sides[0], triangle.sides[1]), splat(never),
                             larger(when, left));
    }
    /// Where the centre is over the face from p along a side and along the axis backwards.
    [[nodiscard]] ESPALIER_NOINLINE Floats parallelogram(const Floats3& p, const Floats3& side,
                                                         const Floats3& back) const {
        using namespace time_bounds;
        const Floats3 normal = cross(side, back);
        const Floats of_side = length_bound(side), of_back = length_bound(back);
        const Floats far =
            multiply(add(add(add(length_bound(p), way_length_), radius_), add(of_side, of_back)), splat(rounding));
        const Floats product = multiply(of_side, of_back), squared = dot(normal, normal);
        const Interval plane = plane_of(normal, squared, p, multiply(product, far));
        const auto along = [&](const Floats3& across, Floats length) {
            return Interval{negate(dot(across, p)), dot(across, way_), splat(0.0f), squared,
                            multiply(multiply(product, length), far)};
        };
        const Interval on_side = along(cross(back, normal), of_back), on_back = along(cross(normal, side), of_side);
        const Floats when = largest_of(plane.entry(), on_side.entry(), on_back.entry());
        const Floats left = largest_of(plane.is_left_at(when), on_side.is_left_at(when), on_back.is_left_at(when));
        return where_at_most(squared, flat_below(side, back), splat(never), larger(when, left));
    }
    /// Returns 0 where the axis may cross the triangle at the start, and `never` elsewhere: the centre is in the prism.
    [[nodiscard]] ESPALIER_NOINLINE Floats crossing(const Triangle& triangle) const {
        using namespace time_bounds;
        const Floats3* const p = triangle.corners;
        const Floats reach = largest_of(length_bound(p[0]), length_bound(p[1]), length_bound(p[2]));
        const Floats length = length_bound(axis_);
        const Floats here = dot(triangle.normal, p[0]), there = subtract(here, dot(triangle.normal, axis_));
        const Floats plane_error = multiply(multiply(triangle.product, add(reach, length)), splat(rounding));
        Floats volumes[3];
        for (int i = 0; i < 3; ++i) volumes[i] = dot(axis_, cross(p[i], p[i == 2 ? 0 : i + 1]));
        const Floats error = multiply(multiply(multiply(reach, reach), length), splat(rounding));
        const Floats least = smaller(volumes[0], smaller(volumes[1], volumes[2]));
        const Floats apart =
            larger(subtract(smaller(here, there), plane_error), negate(add(larger(here, there), plane_error)));
        const Floats beside =
            smaller(negate(add(least, error)), subtract(largest_of(volumes[0], volumes[1], volumes[2]), error));
        return where_positive(larger(apart, beside), splat(never), splat(0.0f));
    }

    /// The distance from the plane of a face, times the length of its normal: within the radius.
    [[nodiscard]] time_bounds::Interval plane_of(const Floats3& normal, Floats squared, const Floats3& p,
                                                 Floats error) const {
        const Floats thick = multiply(square_roots(squared), multiply(radius_, splat(1.0f + time_bounds::rounding)));
        return {negate(dot(normal, p)), dot(normal, way_), negate(thick), thick, error};
    }
    /// A squared length: a face whose normal is no longer is a side, but for what floats round.
    static Floats flat_below(const Floats3& a, const Floats3& b) {
        return multiply(multiply(dot(a, a), dot(b, b)), splat(0x1p-44f));
    }

    Floats3 way_, axis_;
    Floats radius_, squared_radius_, way_length_, squared_way_;
    bool is_sphere_;
};

ESPALIER_END_SET

#endif
