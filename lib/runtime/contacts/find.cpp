// The contacts of a body: the triangles near it, one after the other, and the deepest of their places.
#include <espalier/contact.hpp>
#include <espalier/distance.hpp>
#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/asset/internal_edges.hpp>
#include <runtime/contacts/bodies.hpp>
#include <runtime/contacts/surface_around.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/proximity/winding.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier {

using namespace detail;
using detail::contacts::Body;
using detail::contacts::FacingSide;
using detail::contacts::NearTriangle;
using detail::contacts::NearTriangles;
using detail::contacts::SurfaceAround;
using detail::contacts::Touch;
using detail::contacts::Touches;

namespace {

/// The contacts so far, sorted; of more than there are places the deepest.
class SortedContacts {
public:
    explicit SortedContacts(std::span<Contact> room) : room_(room) {}

    void add(const Contact& contact) {
        std::size_t place = count_;
        is_empty_ = false;
        if (count_ == room_.size()) {
            if (place == 0 || !comes_first(contact, room_[place - 1])) return;
            --place;
        } else {
            ++count_;
        }
        for (; place > 0 && comes_first(contact, room_[place - 1]); --place) room_[place] = room_[place - 1];
        room_[place] = contact;
    }
    /// Lets no contact be deeper. They stay sorted.
    void limit_depth(float deepest) {
        for (Contact& contact : room_.first(count_)) contact.distance = maximum(contact.distance, deepest);
    }
    /// Whether all places are taken by contacts that are no farther away.
    [[nodiscard]] bool are_full_within(float distance) const {
        return count_ == room_.size() && !is_empty_ && (count_ == 0 || room_[count_ - 1].distance <= distance);
    }
    [[nodiscard]] Filled filled() const {
        return {count_, {}, are_full_within(infinity) ? QueryStatus::output_full : QueryStatus::ok};
    }

private:
    static bool comes_first(const Contact& a, const Contact& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
    }

    std::span<Contact> room_;
    std::size_t count_ = 0;
    bool is_empty_ = true;  ///< nothing was added
};

/// Takes triangles from the walk.
struct ContactsOf : Each {
    Body& body;
    const Blob& owner;
    float margin;        ///< in the caller's units
    float margin_steps;  ///< lattice steps
    SortedContacts& sorted;
    float flat_cosine;
    float deepest = infinity;  ///< the least distance of the body and a triangle, before any correction

    ContactsOf(const Blob& of_blob, Body& of_body, float within, const TriangleVisitor& by_id, NearTriangles<>& waiting,
               SortedContacts& into)
        : Each(data_of(of_blob), by_id),
          body(of_body),
          owner(of_blob),
          margin(within),
          margin_steps(radius_in_steps(data_of(of_blob), within)),
          sorted(into),
          flat_cosine(square_root(1.0f - contacts::flat_limit_of(blob))),
          waiting_(waiting),
          // Only then does it matter, and with duplicate references walks may meet triangles in different orders.
          are_all_waiting_(takes_shortcut(body.is_exact && blob.edge_flags != nullptr && blob.copies == nullptr)) {
        on_triangle = [](Each& self, std::uint32_t index, const LatticeTriangle& triangle) {
            return static_cast<ContactsOf&>(self).take(index, triangle);
        };
    }

    Visit take(std::uint32_t index, const LatticeTriangle& triangle) {
        if (takes_shortcut(are_all_waiting_) && waiting_.are_full()) {
            are_all_waiting_ = false;
            add_waiting();
        }
        NearTriangle near = {index, triangle};
        if (takes_shortcut(are_all_waiting_)) waiting_.add(near);
        else add(near, {});
        return Visit::next;
    }
    /// Adds the contacts of the triangles that were put aside.
    void add_waiting() {
        const std::span<NearTriangle> known = are_all_waiting_ ? waiting_.all() : std::span<NearTriangle>();
        for (NearTriangle& near : waiting_.all()) add(near, known);
        waiting_.clear();
    }

private:
    void add(NearTriangle& near, std::span<NearTriangle> known) {
        const LatticeTriangle& triangle = near.triangle;
        const bool is_behind = is_origin_behind(body.seen(triangle));
        FacingSide side = {is_behind, internal_features(owner, TriangleId{near.index}), {}, {}, flat_cosine};
        const SurfaceAround around(owner, body, near.index, triangle, side, known);
        const auto faces = [&around](Feature feature) { return around.faces(feature); };
        side.faces = faces;
        const auto find_nearest_side = [this](const Vec3& face, bool& is_behind_it) {
            return find_side_of_nearest(face, is_behind_it);
        };
        side.find_nearest_side = find_nearest_side;
        Touches touches;
        body.touch(triangle, side, body.radius + margin_steps, touches);
        if (touches.count == 0) return;
        near.nearest = touches.nearest;
        deepest = minimum(deepest, to_local_distance(touches.nearest));
        if (touches.is_beside && around.has_nearer(touches)) return;
        const float steepness = dot(face_normal_of(triangle), touches.touch[0].normal);
        for (unsigned i = 0; i < touches.count; ++i) {
            const Touch& touch = touches.touch[i];
            Contact contact;
            contact.point = to_local(blob, touch.point.x, touch.point.y, touch.point.z);
            contact.normal = touch.normal;
            contact.distance = to_local_distance(touch.distance);
            contact.triangle = TriangleId{near.index};
            contact.feature = touch.feature;
            contact.side = (absolute(steepness) > steep ? steepness < 0.0f : is_behind) ? Side::back : Side::front;
            sorted.add(contact);
        }
    }

    /// FacingSide::find_nearest_side. Where only a joined edge or corner is nearest and the middle is far beside it,
    /// the surface goes on below the middle in another blob.
    bool find_side_of_nearest(const Vec3& face, bool& is_behind) {
        if (nearest_.status == QueryStatus::not_open) nearest_ = closest_point(owner, body.shape_middle);
        if (!(dot(face, nearest_.face_normal) > 0.5f)) return true;
        is_behind = nearest_.side == Side::back;
        return !is_behind || !internal_features(owner, nearest_.triangle).have(nearest_.feature, true) ||
               dot(nearest_.face_normal, nearest_.point - body.shape_middle) > 0.7f * nearest_.distance;
    }
    /// Returns the distance of the body's surface for that of its core in steps: a huge radius is more steps than a
    /// float holds.
    [[nodiscard]] float to_local_distance(float of_core) const {
        return minimum(scale_by_power_of_two(of_core, blob.step_exponent) - body.least_reach,
                       margin);  // decided before
    }

    /// The cosine from which on a normal clearly leaves a triangle on one side.
    static constexpr float steep = 0.5f;
    ClosestPoint nearest_;  ///< to the middle: looked for once, where that matters
    NearTriangles<>& waiting_;
    bool are_all_waiting_;  ///< all that were taken
};

/// With no more places than these the nearest contacts are looked for first.
constexpr std::size_t most_few = 4;

/// Finds the exit of a solid for a body whose middle is inside; not_found for others. Where triangles face inward, as
/// in a room that is a closed surface of its own, the winding number is negative, and the body meets the walls instead.
QueryStatus find_exit(const Blob& blob, const Body& body, Contact& contact) {
    if (!blob.is_closed()) return QueryStatus::not_found;
    const Vec3 middle = body.shape_middle;
    if (!is_finite(middle) || winding_around(data_of(blob), middle).number <= 0) return QueryStatus::not_found;
    const ClosestPoint nearest = closest_point(blob, middle);
    if (nearest.status != QueryStatus::ok || nearest.distance == 0.0f) return QueryStatus::not_found;
    contact.point = nearest.point;
    contact.triangle = nearest.triangle;
    contact.feature = nearest.feature;
    contact.side = nearest.side;
    const Vec3 outward = nearest.face_normal * (nearest.side == Side::back ? 1.0f : -1.0f);
    contact.normal = nearest.feature == Feature::face ? outward : contacts::direction_of(nearest.point - middle);
    if (largest(contact.normal) == 0.0f) contact.normal = outward;  // far from the origin they round alike
    contact.distance = -(nearest.distance + body.functions->reach_of(body.shape, contact.normal));
    return QueryStatus::ok;
}

/// Returns a margin, at most the given one, within which a body probably has a contact: of a few contacts the nearest
/// are then found without those that are far away.
float first_margin(const Blob& blob, const Body& body, float margin) {
    const float reach = body.most_reach;
    const ClosestPoint nearest = body.functions->nearest(blob, body, (reach + margin) * (1.0f + 0x1p-16f));
    if (nearest.status != QueryStatus::ok) return margin;
    // For a sphere and a capsule this is the distance, and below 0 the depth.
    const float least = maximum(nearest.distance - reach, -body.least_reach);
    const float most = maximum(nearest.distance - body.least_reach, least);
    const float step = scale_by_power_of_two(1.0f, data_of(blob).step_exponent);
    return minimum(least + (most - least) * (1.0f / 16.0f) + nearest.distance * 0x1p-12f + step, margin);
}

Filled find_contacts_of_body(const Blob& blob, Body& body, float margin, std::span<Contact> contacts) {
    Contact exit;
    if (find_exit(blob, body, exit) == QueryStatus::ok) {
        SortedContacts sorted(contacts);
        sorted.add(exit);
        return sorted.filled();
    }
    // A margin that is small beside the body adds few.
    const bool is_wide = margin > 0.25f * body.most_reach;
    float within = is_wide && contacts.size() <= most_few ? first_margin(blob, body, margin) : margin;
    for (;;) {
        SortedContacts sorted(contacts);
        // Where the leaf is not at hand, on small cores, the triangle is searched.
        ContactsOf* self = nullptr;
        const auto search = [&](TriangleId triangle) {
            return self->take(triangle.index, find_triangle(data_of(blob), triangle.index));
        };
        NearTriangles<> waiting;
        ContactsOf answer(blob, body, margin, search, waiting, sorted);
        self = &answer;
        const QueryStatus status = body.functions->find_near(data_of(blob), body.shape, within, answer);
        if (is_refused(status)) return {0, {}, status};
        answer.add_waiting();
        // Any triangle that was not met is farther away than `within`, but for rounding.
        if (!(within < margin) || sorted.are_full_within(within - (within + body.most_reach) * 0x1p-16f)) {
            sorted.limit_depth(answer.deepest);
            return sorted.filled();
        }
        const float next = within + maximum(absolute(within), 0.25f * body.most_reach);
        within = next > within ? minimum(next, margin) : margin;
    }
}

bool is_sound(const Sphere& sphere) { return is_radius(sphere.radius) && is_finite(sphere.radius); }
bool is_sound(const Capsule& capsule) { return is_radius(capsule.radius) && is_finite(capsule.radius); }
bool is_sound(const OrientedBox& box) { return is_finite(box); }
bool is_sound(const ConvexHull& hull) {
    bool sound = hull.vertices.size() <= max_hull_vertices;
    for (std::size_t i = 0; sound && i < hull.vertices.size(); ++i) sound = is_finite(hull.vertices[i]);
    return sound;
}

}  // namespace

template <ContactBody Shape>
Filled find_contacts(const Blob& blob, const Shape& shape, float margin, std::span<Contact> contacts) noexcept {
    if (!blob) return {};
    if (!is_sound(shape) || !is_radius(margin) || !is_finite(margin)) return {0, {}, QueryStatus::invalid_argument};
    detail::contacts::BodyOf<Shape> body;
    const QueryStatus rounded = body.round(data_of(blob), shape, margin);
    if (is_refused(rounded)) return {0, {}, rounded};
    if (rounded == QueryStatus::not_found) return {0, {}, QueryStatus::ok};
    return find_contacts_of_body(blob, body, margin, contacts);
}
template Filled find_contacts(const Blob&, const Sphere&, float, std::span<Contact>) noexcept;
template Filled find_contacts(const Blob&, const Capsule&, float, std::span<Contact>) noexcept;
template Filled find_contacts(const Blob&, const OrientedBox&, float, std::span<Contact>) noexcept;
template Filled find_contacts(const Blob&, const ConvexHull&, float, std::span<Contact>) noexcept;

}  // namespace espalier
