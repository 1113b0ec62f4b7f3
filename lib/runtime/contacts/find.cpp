// The contacts of a body: the triangles near it, one after the other, and the deepest of their places.
#include <type_traits>

#include <espalier/contact.hpp>
#include <espalier/distance.hpp>
#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/asset/internal_edges.hpp>
#include <runtime/contacts/bodies.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/kernels/face.hpp>
#include <runtime/lattice/to_world.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier {

using namespace detail;
using detail::contacts::CapsuleBody;
using detail::contacts::ConvexHullBody;
using detail::contacts::OrientedBoxBody;
using detail::contacts::SphereBody;
using detail::contacts::Touch;
using detail::contacts::Touches;

namespace {

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
