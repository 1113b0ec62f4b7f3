// The contacts of a body: the triangles near it, one after the other, and the deepest of their places.
#include <type_traits>

#include <espalier/contact.hpp>
#include <espalier/distance.hpp>
#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/asset/internal_edges.hpp>
#include <runtime/contacts/hull_body.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/face.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/lattice/to_world.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier {

using namespace detail;
using detail::contacts::Touch;
using detail::contacts::Touches;

namespace {

/// The body as the contacts need it: its middle, how far it reaches in a direction, and its kernel.
struct SphereBody {
    RoundedPoint center;
    float radius;  ///< lattice steps

    QueryStatus round(const BlobData& blob, const Sphere& sphere, float margin) {
        radius = radius_in_steps(blob, sphere.radius);
        return round_point(blob, sphere.center, sphere.radius + margin, center);
    }
    [[nodiscard]] OriginRelative seen(const LatticeTriangle& triangle) const { return relative_to(center, triangle); }
    [[nodiscard]] int fraction_bits() const { return center.fraction_bits; }
    [[nodiscard]] static float core_reach(const Vec3&) { return 0.0f; }
    void touch(const LatticeTriangle& triangle, float, Touches& touches) const {
        contacts::touch_point(center, triangle, touches);
    }
    static Vec3 middle_of(const Sphere& sphere) { return sphere.center; }
    static float reach_of(const Sphere& sphere, const Vec3&) { return sphere.radius; }
    static Sphere grown(const Sphere& sphere, float margin) { return {sphere.center, sphere.radius + margin}; }
};

struct CapsuleBody {
    RoundedSegment segment;
    Integer3 doubled_middle;
    float radius;

    QueryStatus round(const BlobData& blob, const Capsule& capsule, float) {
        radius = radius_in_steps(blob, capsule.radius);
        const QueryStatus status = round_segment(blob, {capsule.from, capsule.to}, segment);
        if (status == QueryStatus::ok) doubled_middle = segment.from + segment.to;
        return status;
    }
    [[nodiscard]] OriginRelative seen(const LatticeTriangle& triangle) const {
        return relative_to(doubled_middle, fraction_bits(), triangle);
    }
    [[nodiscard]] int fraction_bits() const { return segment.fraction_bits + 1; }
    [[nodiscard]] float core_reach(const Vec3& way) const {
        const Integer3 whole = segment.to - segment.from;
        const Vec3 axis = {to_float(whole.x), to_float(whole.y), to_float(whole.z)};
        return absolute(contacts::dot(axis, way)) * power_of_two(-fraction_bits());
    }
    void touch(const LatticeTriangle& triangle, float reach, Touches& touches) const {
        contacts::touch_segment(segment, triangle, reach, touches);
    }
    static Vec3 middle_of(const Capsule& capsule) {
        const Vec3 &a = capsule.from, &b = capsule.to;
        return {0.5f * a.x + 0.5f * b.x, 0.5f * a.y + 0.5f * b.y, 0.5f * a.z + 0.5f * b.z};
    }
    static float reach_of(const Capsule& capsule, const Vec3& way) {
        const Vec3 &a = capsule.from, &b = capsule.to;
        const Vec3 half = {0.5f * b.x - 0.5f * a.x, 0.5f * b.y - 0.5f * a.y, 0.5f * b.z - 0.5f * a.z};
        return capsule.radius + absolute(half.x * way.x + half.y * way.y + half.z * way.z);
    }
    static Capsule grown(const Capsule& capsule, float margin) {
        return {capsule.from, capsule.to, capsule.radius + margin};
    }
};

struct OrientedBoxBody {
    contacts::BoxBody box;
    static constexpr float radius = 0.0f;

    QueryStatus round(const BlobData& blob, const OrientedBox& world, float margin) {
        float center[3], half[3][3], spread[3] = {};
        Rounder rounder(blob);
        for (int i = 0; i < 3; ++i) {
            rounder.add_vector(world.half_axes[i], half[i]);
            for (int k = 0; k < 3; ++k) spread[k] += absolute(half[i][k]);
        }
        rounder.add_point(world.center, center);
        const float near = radius_in_steps(blob, margin);
        bool is_away = false;
        for (int k = 0; k < 3; ++k) {
            rounder.extend(rounder.distance(k, center[k]) + spread[k]);
            const float last = blob.extent_steps[k];
            const float gap = center[k] < 0.0f ? -center[k] : center[k] > last ? center[k] - last : 0.0f;
            is_away = is_away || gap > (spread[k] + near) * (1.0f + 0x1p-20f) + 4.0f;
        }
        if (is_away) return QueryStatus::not_found;
        if (!(rounder.reach() < shape_reach)) return QueryStatus::out_of_range;
        box.fraction_bits = fraction_bits_for(rounder.reach(), volume_grid);
        box.center = to_grid(center, box.fraction_bits);
        const float scale = power_of_two(-box.fraction_bits);
        auto& units = box.units;
        box.size = 0.0f;
        for (int i = 0; i < 3; ++i) {
            units[i] = to_grid(half[i], box.fraction_bits);
            box.half[i] = {to_float(units[i].x) * scale, to_float(units[i].y) * scale, to_float(units[i].z) * scale};
            box.size += absolute(box.half[i].x) + absolute(box.half[i].y) + absolute(box.half[i].z);
        }
        for (int i = 0; i < 3; ++i)
            box.face[i] = contacts::direction_of(wide_cross(units[i == 2 ? 0 : i + 1], units[i == 0 ? 2 : i - 1]));
        return QueryStatus::ok;
    }
    [[nodiscard]] OriginRelative seen(const LatticeTriangle& triangle) const {
        return relative_to(box.center, box.fraction_bits, triangle);
    }
    [[nodiscard]] int fraction_bits() const { return box.fraction_bits; }
    [[nodiscard]] float core_reach(const Vec3& way) const { return reach_along(box.half, way); }
    void touch(const LatticeTriangle& triangle, float reach, Touches& touches) const {
        contacts::touch_box(box, triangle, reach, touches);
    }
    static Vec3 middle_of(const OrientedBox& world) { return world.center; }
    static float reach_of(const OrientedBox& world, const Vec3& way) { return reach_along(world.half_axes, way); }
    static float reach_along(const Vec3 (&half_axes)[3], const Vec3& way) {
        float sum = 0.0f;
        for (const Vec3& half : half_axes) sum += absolute(contacts::dot(half, way));
        return sum;
    }
    /// The box along the axes around it and the margin, with room for rounding.
    static Box grown(const OrientedBox& world, float margin) {
        Vec3 reach;
        for (const Vec3& half : world.half_axes) {
            reach.x += absolute(half.x);
            reach.y += absolute(half.y);
            reach.z += absolute(half.z);
        }
        const Vec3& c = world.center;
        constexpr float more = 1.0f + 0x1p-20f;
        const auto far = [&](float at, float by) { return by * more + margin * more + absolute(at) * 0x1p-20f; };
        const Vec3 by = {far(c.x, reach.x), far(c.y, reach.y), far(c.z, reach.z)};
        return {{c.x - by.x, c.y - by.y, c.z - by.z}, {c.x + by.x, c.y + by.y, c.z + by.z}};
    }
};

struct ConvexHullBody {
    contacts::HullBody hull;
    bool has_faces = false;  ///< found with the first triangle: a body in the open takes no time for them
    static constexpr float radius = 0.0f;

    [[gnu::noinline]] QueryStatus round(const BlobData& blob, const ConvexHull& world, float margin) {
        if (world.vertices.empty()) return QueryStatus::not_found;
        float at[3], low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
        Rounder rounder(blob);
        for (const Vec3& vertex : world.vertices) {
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
        for (const Vec3& vertex : world.vertices) {
            rounder.add_point(vertex, at);
            for (int k = 0; k < 3; ++k) hull.vertex[count][k] = static_cast<std::int32_t>(to_grid(at[k], bits));
            ++count;
        }
        contacts::set_vertices(hull, hull.vertex, count, bits);
        return QueryStatus::ok;
    }
    [[nodiscard]] OriginRelative seen(const LatticeTriangle& triangle) const {
        return relative_to(hull.middle, hull.fraction_bits, triangle);
    }
    [[nodiscard]] int fraction_bits() const { return hull.fraction_bits; }
    [[nodiscard]] float core_reach(const Vec3& way) const {
        float most = 0.0f;
        for (unsigned i = 0; i < hull.vertex_count; ++i) most = maximum(most, -contacts::dot(hull.at(i), way));
        return most;
    }
    void touch(const LatticeTriangle& triangle, float reach, Touches& touches) {
        if (!has_faces) contacts::find_faces(hull);
        has_faces = true;
        contacts::touch_hull(hull, triangle, reach, touches);
    }
    static Vec3 middle_of(const ConvexHull& world) {
        const float share = 1.0f / static_cast<float>(world.vertices.size());
        Vec3 middle;
        for (const Vec3& vertex : world.vertices)
            middle = contacts::operator+(middle, contacts::operator*(vertex, share));
        return middle;
    }
    static float reach_of(const ConvexHull& world, const Vec3& way) {
        const Vec3 middle = middle_of(world);
        float most = 0.0f;
        for (const Vec3& vertex : world.vertices)
            most = maximum(most, contacts::dot(contacts::operator-(middle, vertex), way));
        return most;
    }
    /// The box along the axes around it and the margin, with room for rounding.
    static Box grown(const ConvexHull& world, float margin) {
        if (world.vertices.empty()) return {};
        Vec3 low = world.vertices.front(), high = low;
        for (const Vec3& v : world.vertices) {
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

/// The contacts so far, sorted; of more than there are places the deepest.
class SortedContacts {
public:
    explicit SortedContacts(std::span<Contact> room) : room_(room) {}

    void add(const Contact& contact) {
        std::size_t place = count_;
        if (count_ == room_.size()) {
            is_full_ = true;
            if (place == 0 || !comes_first(contact, room_[place - 1])) return;
            --place;
        } else {
            ++count_;
        }
        for (; place > 0 && comes_first(contact, room_[place - 1]); --place) room_[place] = room_[place - 1];
        room_[place] = contact;
    }
    [[nodiscard]] Filled filled() const { return {count_, {}, is_full_ ? QueryStatus::output_full : QueryStatus::ok}; }

private:
    static bool comes_first(const Contact& a, const Contact& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
    }

    std::span<Contact> room_;
    std::size_t count_ = 0;
    bool is_full_ = false;
};

/// Takes triangles from the walk.
template <class Body>
struct ContactsOf : Each {
    Body& body;
    const Blob& owner;
    float margin;        ///< of the caller
    float margin_steps;  ///< lattice steps
    SortedContacts& sorted;

    ContactsOf(const Blob& of_blob, Body& of_body, float within, const TriangleVisitor& by_id, SortedContacts& into)
        : Each(data_of(of_blob), by_id), body(of_body), owner(of_blob), margin(within), sorted(into) {
        margin_steps = radius_in_steps(data_of(of_blob), within);
        on_triangle = [](Each& self, std::uint32_t index, const LatticeTriangle& triangle) {
            return static_cast<ContactsOf&>(self).add(index, triangle);
        };
    }

    Visit add(std::uint32_t index, const LatticeTriangle& triangle) {
        Touches touches;
        body.touch(triangle, body.radius + margin_steps, touches);
        if (touches.count == 0) return Visit::next;
        const OriginRelative seen = body.seen(triangle);
        const bool is_behind = is_origin_behind(seen);
        const bool on_internal_edge = touches.touch[0].feature != Feature::face &&
                                      is_internal(owner, TriangleId{index}, touches.touch[0].feature);
        for (unsigned i = 0; i < touches.count; ++i) {
            Touch& touch = touches.touch[i];
            if (on_internal_edge) turn_to_face(touch, face_normal_of(triangle), seen, is_behind);
            touch.distance -= body.radius;
            Contact contact;
            contact.point = to_world(blob, touch.point.x, touch.point.y, touch.point.z);
            contact.normal = touch.normal;
            contact.distance =
                minimum(scale_by_power_of_two(touch.distance, blob.step_exponent), margin);  // decided before
            contact.triangle = TriangleId{index};
            contact.feature = touch.feature;
            contact.side = is_behind ? Side::back : Side::front;
            sorted.add(contact);
        }
        return Visit::next;
    }

private:
    /// Gives a place on an internal edge the normal of the face, the distance along it and the point there, on the
    /// plane of the face. Where the body's core touches the triangle, the distance is that in which it leaves the
    /// plane.
    void turn_to_face(Touch& touch, Vec3 normal, const OriginRelative& seen, bool is_behind) const {
        using contacts::operator+;
        using contacts::operator-;
        using contacts::operator*;
        if (contacts::dot(normal, normal) == 0.0f) return;
        const float share = contacts::dot(normal, touch.normal);
        const bool is_apart = touch.distance >= 0.0f;
        if (is_apart ? share < 0.0f : is_behind) normal = normal * -1.0f;
        if (is_apart) {
            const Vec3 core = touch.point + touch.normal * touch.distance;
            touch.distance *= absolute(share);
            touch.point = core - normal * touch.distance;
        } else {
            const Vec3 corner = {to_float(seen.a.x), to_float(seen.a.y), to_float(seen.a.z)};
            const float level = contacts::dot(corner, normal) * -power_of_two(-body.fraction_bits());
            touch.distance = minimum(touch.distance, level - body.core_reach(normal));
        }
        touch.normal = normal;
    }
};

/// Finds the exit of a closed surface for a body whose middle is inside; not_found for others.
template <class Body, class Shape>
QueryStatus find_exit(const Blob& blob, const Shape& shape, Contact& contact) {
    if (!blob.is_closed()) return QueryStatus::not_found;
    const Vec3 middle = Body::middle_of(shape);
    if (!contains(blob, middle).yes()) return QueryStatus::not_found;
    const ClosestPoint nearest = closest_point(blob, middle);
    if (nearest.status != QueryStatus::ok || nearest.distance == 0.0f) return QueryStatus::not_found;
    contact.point = nearest.point;
    contact.triangle = nearest.triangle;
    contact.feature = nearest.feature;
    contact.side = nearest.side;
    using contacts::operator-;
    using contacts::operator*;
    contact.normal = nearest.feature == Feature::face
                         ? nearest.face_normal * (nearest.side == Side::back ? 1.0f : -1.0f)
                         : contacts::direction_of(nearest.point - middle);
    contact.distance = -(nearest.distance + Body::reach_of(shape, contact.normal));
    return QueryStatus::ok;
}

template <class Body, class Shape>
Filled find_contacts_of(const Blob& blob, const Shape& shape, float margin, std::span<Contact> contacts) {
    Filled filled;
    if (!blob) return filled;
    filled.status = QueryStatus::invalid_argument;
    if (!is_radius(margin) || !is_finite(margin)) return filled;
    Body body;
    const auto grown = Body::grown(shape, margin);
    SortedContacts sorted(contacts);
    // Where the leaf is not at hand, on small cores, the triangle is searched.
    ContactsOf<Body>* self = nullptr;
    const auto search = [&](TriangleId triangle) {
        return self->add(triangle.index, find_triangle(data_of(blob), triangle.index));
    };
    ContactsOf<Body> answer(blob, body, margin, search, sorted);
    self = &answer;
    const QueryStatus rounded = body.round(data_of(blob), shape, margin);
    if (is_refused(rounded)) return {0, {}, rounded};
    if (rounded == QueryStatus::not_found) return {0, {}, QueryStatus::ok};
    Contact exit;
    if (find_exit<Body>(blob, shape, exit) == QueryStatus::ok) {
        sorted.add(exit);
        return sorted.filled();
    }
    const QueryStatus status =
        find_overlaps_of<std::remove_const_t<decltype(grown)>>(data_of(blob), &grown, answer, exactly);
    return is_refused(status) ? Filled{0, {}, status} : sorted.filled();
}

}  // namespace

Filled find_contacts(const Blob& blob, const Sphere& sphere, float margin, std::span<Contact> contacts) noexcept {
    if (blob && (!is_radius(sphere.radius) || !is_finite(sphere.radius))) return {0, {}, QueryStatus::invalid_argument};
    return find_contacts_of<SphereBody>(blob, sphere, margin, contacts);
}

Filled find_contacts(const Blob& blob, const Capsule& capsule, float margin, std::span<Contact> contacts) noexcept {
    if (blob && (!is_radius(capsule.radius) || !is_finite(capsule.radius)))
        return {0, {}, QueryStatus::invalid_argument};
    return find_contacts_of<CapsuleBody>(blob, capsule, margin, contacts);
}

Filled find_contacts(const Blob& blob, const OrientedBox& box, float margin, std::span<Contact> contacts) noexcept {
    if (blob) {
        bool all_finite = is_finite(box.center);
        for (const Vec3& half : box.half_axes) all_finite = all_finite && is_finite(half);
        if (!all_finite) return {0, {}, QueryStatus::invalid_argument};
    }
    return find_contacts_of<OrientedBoxBody>(blob, box, margin, contacts);
}

Filled find_contacts(const Blob& blob, const ConvexHull& hull, float margin, std::span<Contact> contacts) noexcept {
    if (blob) {
        bool is_valid = hull.vertices.size() <= max_hull_vertices;
        for (std::size_t i = 0; is_valid && i < hull.vertices.size(); ++i) is_valid = is_finite(hull.vertices[i]);
        if (!is_valid) return {0, {}, QueryStatus::invalid_argument};
    }
    return find_contacts_of<ConvexHullBody>(blob, hull, margin, contacts);
}

}  // namespace espalier
