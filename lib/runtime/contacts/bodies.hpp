// Bodies as find_contacts() takes them. The search is compiled once for all of them: a copy for each shape would take
// 18 KB of code and save nothing that can be measured.
#pragma once

#include <type_traits>

#include <espalier/distance.hpp>
#include <espalier/overlap.hpp>
#include <espalier/shapes.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/contacts/hull_body.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/lattice/rounder.hpp>

namespace espalier::detail::contacts {

/// What the search needs of a body, rounded for a blob.
struct Body {
    const Integer3* middle;  ///< its own, in units of 2^-fraction_bits lattice steps
    int fraction_bits;       ///< of the middle
    float radius;            ///< lattice steps; 0 for shapes without one

    // The caller's shape, in the caller's units:
    const void* shape;
    Vec3 shape_middle;
    float least_reach;  ///< how far it reaches, at least, from what of it nearest() measures
    float most_reach;   ///< and at most
    bool is_exact;      ///< exact kernels decide what is near it, and where: a sphere's or a capsule's

    struct Functions {
        void (*touch)(Body& self, const LatticeTriangle& triangle, const FacingSide& side, float reach,
                      Touches& touches);
        /// How far it reaches from its middle against a unit vector.
        float (*reach_of)(const void* shape, const Vec3& way);
        ClosestPoint (*nearest)(const Blob& blob, const Body& self, float within);
        /// Hands over the triangles that are no farther away than the margin, and maybe others.
        QueryStatus (*find_near)(const BlobData& blob, const void* shape, float margin, Each& answer);
    };
    const Functions* functions;

    Body() = default;
    Body(const Body&) = delete;  // `middle` is within
    [[nodiscard]] OriginRelative seen(const LatticeTriangle& triangle) const {
        return relative_to(*middle, fraction_bits, triangle);
    }
    /// Writes how it touches a triangle, or is no farther from it than `reach`, in lattice steps without the radius.
    void touch(const LatticeTriangle& triangle, const FacingSide& side, float reach, Touches& touches) {
        functions->touch(*this, triangle, side, reach, touches);
    }

    /// Returns the closest point to its middle; that of a capsule to its axis.
    static ClosestPoint nearest(const Blob& blob, const Body& self, float within) {
        return closest_point(blob, self.shape_middle, within);
    }

protected:
    template <class OwnBody, class Shape>
    void refer_to(const Shape& own, const Vec3& own_middle, float least, float most) {
        static constexpr Functions of_body = {
            [](Body& self, const LatticeTriangle& triangle, const FacingSide& side, float reach, Touches& touches) {
                static_cast<OwnBody&>(self).touch_triangle(triangle, side, reach, touches);
            },
            [](const void* of, const Vec3& way) { return OwnBody::reach_of(*static_cast<const Shape*>(of), way); },
            OwnBody::nearest,
            [](const BlobData& blob, const void* of, float margin, Each& answer) {
                const auto grown = OwnBody::grown(*static_cast<const Shape*>(of), margin);
                return find_overlaps_of<std::remove_const_t<decltype(grown)>>(blob, &grown, answer, exactly);
            }};
        functions = &of_body;
        shape = &own;
        shape_middle = own_middle;
        least_reach = least;
        most_reach = most;
        is_exact = OwnBody::grows_to_itself;
    }
};

/// A shape of the caller as a body: round() fills it in.
template <class Shape>
struct BodyOf;

template <>
struct BodyOf<Sphere> : Body {
    static constexpr bool grows_to_itself = true;
    RoundedPoint center;
    Integer3 origin;

    QueryStatus round(const BlobData& blob, const Sphere& sphere, float margin) {
        refer_to<BodyOf>(sphere, sphere.center, sphere.radius, sphere.radius);
        radius = radius_in_steps(blob, sphere.radius);
        const QueryStatus status = round_point(blob, sphere.center, sphere.radius + margin, center);
        origin = {center.origin[0], center.origin[1], center.origin[2]};
        middle = &origin;
        fraction_bits = center.fraction_bits;
        return status;
    }
    void touch_triangle(const LatticeTriangle& triangle, const FacingSide& side, float, Touches& touches) const {
        touch_point(center, triangle, side, touches);
    }
    static float reach_of(const Sphere& sphere, const Vec3&) { return sphere.radius; }
    static Sphere grown(const Sphere& sphere, float margin) { return {sphere.center, sphere.radius + margin}; }
};

template <>
struct BodyOf<Capsule> : Body {
    static constexpr bool grows_to_itself = true;
    RoundedSegment segment;
    Integer3 doubled_middle;

    QueryStatus round(const BlobData& blob, const Capsule& capsule, float) {
        refer_to<BodyOf>(capsule, capsule.from * 0.5f + capsule.to * 0.5f, capsule.radius, capsule.radius);
        radius = radius_in_steps(blob, capsule.radius);
        const QueryStatus status = round_segment(blob, {capsule.from, capsule.to}, segment);
        if (status == QueryStatus::ok) {
            doubled_middle = segment.from + segment.to;
            middle = &doubled_middle;
            fraction_bits = segment.fraction_bits + 1;
        }
        return status;
    }
    void touch_triangle(const LatticeTriangle& triangle, const FacingSide& side, float reach, Touches& touches) const {
        touch_segment(segment, triangle, side, reach, touches);
    }
    static float reach_of(const Capsule& capsule, const Vec3& way) {
        return capsule.radius + absolute(dot(capsule.to * 0.5f - capsule.from * 0.5f, way));
    }
    static ClosestPoint nearest(const Blob& blob, const Body& self, float within) {
        const auto& capsule = *static_cast<const Capsule*>(self.shape);
        return closest_point(blob, Segment{capsule.from, capsule.to}, within);
    }
    static Capsule grown(const Capsule& capsule, float margin) {
        return {capsule.from, capsule.to, capsule.radius + margin};
    }
};

template <>
struct BodyOf<OrientedBox> : Body {
    static constexpr bool grows_to_itself = false;  ///< a box does
    BoxBody box;

    QueryStatus round(const BlobData& blob, const OrientedBox& local, float margin) {
        float sum = 0.0f;
        for (const Vec3& half : local.half_axes) sum += sum_of_magnitudes(half);
        refer_to<BodyOf>(local, local.center, 0.0f, sum);
        radius = 0.0f;
        Rounder rounder(blob);
        const OrientedBoxInSteps steps(local, rounder);
        if (steps.is_away(blob, radius_in_steps(blob, margin))) return QueryStatus::not_found;
        if (!(rounder.reach() < shape_reach)) return QueryStatus::out_of_range;
        box.fraction_bits = fraction_bits_for(rounder.reach(), volume_grid);
        box.center = to_grid(steps.center, box.fraction_bits);
        const float scale = power_of_two(-box.fraction_bits);
        auto& units = box.units;
        box.size = 0.0f;
        for (int i = 0; i < 3; ++i) {
            units[i] = to_grid(steps.half[i], box.fraction_bits);
            box.half[i] = to_vector(units[i]) * scale;
            box.size += sum_of_magnitudes(box.half[i]);
        }
        for (int i = 0; i < 3; ++i)
            box.face[i] = direction_of(wide_cross(units[i == 2 ? 0 : i + 1], units[i == 0 ? 2 : i - 1]));
        middle = &box.center;
        fraction_bits = box.fraction_bits;
        return QueryStatus::ok;
    }
    void touch_triangle(const LatticeTriangle& triangle, const FacingSide& side, float reach, Touches& touches) const {
        touch_box(box, triangle, side, reach, touches);
    }
    static float reach_of(const OrientedBox& local, const Vec3& way) {
        float sum = 0.0f;
        for (const Vec3& half : local.half_axes) sum += absolute(dot(half, way));
        return sum;
    }
    /// The box along the axes around it and the margin, with room for rounding.
    static Box grown(const OrientedBox& local, float margin) {
        Vec3 reach;
        for (const Vec3& half : local.half_axes)
            reach = reach + Vec3{absolute(half.x), absolute(half.y), absolute(half.z)};
        const Vec3& c = local.center;
        constexpr float more = 1.0f + 0x1p-20f;
        const auto far = [&](float at, float by) { return by * more + margin * more + absolute(at) * 0x1p-20f; };
        const Vec3 by = {far(c.x, reach.x), far(c.y, reach.y), far(c.z, reach.z)};
        return {c - by, c + by};
    }
};

template <>
struct BodyOf<ConvexHull> : Body {
    static constexpr bool grows_to_itself = false;  ///< a box does
    HullBody hull;
    bool has_faces = false;  ///< found with the first triangle: a body in the open takes no time for them

    ESPALIER_NOINLINE QueryStatus round(const BlobData& blob, const ConvexHull& local, float margin) {
        if (local.vertices.empty()) return QueryStatus::not_found;
        const Vec3 own_middle = middle_of(local);
        float most = 0.0f;
        for (const Vec3& vertex : local.vertices) most = maximum(most, sum_of_magnitudes(vertex - own_middle));
        refer_to<BodyOf>(local, own_middle, 0.0f, most);
        radius = 0.0f;
        float at[3], low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
        Rounder rounder(blob);
        for (const Vec3& vertex : local.vertices) {
            rounder.add_point(vertex, at);
            for (int k = 0; k < 3; ++k) {
                low[k] = minimum(low[k], at[k]);
                high[k] = maximum(high[k], at[k]);
            }
        }
        const float near = radius_in_steps(blob, margin) * (1.0f + 0x1p-20f) + 4.0f;
        for (int k = 0; k < 3; ++k)
            if (low[k] > blob.extent_steps[k] + near || high[k] < -near) return QueryStatus::not_found;
        if (!(rounder.reach() < contact_hull_reach)) return QueryStatus::out_of_range;
        const int bits = fraction_bits_for(rounder.reach(), point_grid);
        unsigned count = 0;
        for (const Vec3& vertex : local.vertices) {
            rounder.add_point(vertex, at);
            for (int k = 0; k < 3; ++k) hull.vertex[count][k] = static_cast<std::int32_t>(to_grid(at[k], bits));
            ++count;
        }
        set_vertices(hull, hull.vertex, count, bits);
        middle = &hull.middle;
        fraction_bits = hull.fraction_bits;
        return QueryStatus::ok;
    }
    void touch_triangle(const LatticeTriangle& triangle, const FacingSide& side, float reach, Touches& touches) {
        if (!has_faces) find_faces(hull);
        has_faces = true;
        touch_hull(hull, triangle, side, reach, touches);
    }
    static Vec3 middle_of(const ConvexHull& local) {
        const float share = 1.0f / static_cast<float>(local.vertices.size());
        Vec3 middle;
        for (const Vec3& vertex : local.vertices) middle = middle + vertex * share;
        return middle;
    }
    static float reach_of(const ConvexHull& local, const Vec3& way) {
        const Vec3 middle = middle_of(local);
        float most = 0.0f;
        for (const Vec3& vertex : local.vertices) most = maximum(most, dot(middle - vertex, way));
        return most;
    }
    /// The box along the axes around it and the margin, with room for rounding.
    static Box grown(const ConvexHull& local, float margin) {
        if (local.vertices.empty()) return {};
        Vec3 low = local.vertices.front(), high = low;
        for (const Vec3& v : local.vertices) {
            low = {minimum(low.x, v.x), minimum(low.y, v.y), minimum(low.z, v.z)};
            high = {maximum(high.x, v.x), maximum(high.y, v.y), maximum(high.z, v.z)};
        }
        const auto by = [margin](float at) { return margin * (1.0f + 0x1p-20f) + absolute(at) * 0x1p-20f; };
        return {{low.x - by(low.x), low.y - by(low.y), low.z - by(low.z)},
                {high.x + by(high.x), high.y + by(high.y), high.z + by(high.z)}};
    }

private:
    /// Nothing of a hull may be as far from the asset, in lattice steps.
    static constexpr float contact_hull_reach = 0x1p29f;
};

}  // namespace espalier::detail::contacts
