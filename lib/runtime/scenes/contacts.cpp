// Contacts of a body with all instances of a scene.
#include <espalier/scenes/contacts.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>
#include <runtime/transforms/local_shape.hpp>

namespace espalier {

using namespace detail;

namespace {

bool comes_before(const InScene<Contact>& a, const InScene<Contact>& b) {
    if (a.hit.distance != b.hit.distance) return a.hit.distance < b.hit.distance;
    return a.instance < b.instance;
}

/// The deepest contacts so far, in order. Of one instance, equally deep ones stay in the order in which they came.
class DeepestContacts {
public:
    explicit DeepestContacts(std::span<InScene<Contact>> places) : places_(places) {}

    void add(const InScene<Contact>& contact) {
        if (count_ < places_.size()) {
            ++count_;
            is_full_ = is_full_ || count_ == places_.size();  // as of one instance
        } else {
            is_full_ = true;
            if (count_ == 0 || !comes_before(contact, places_[count_ - 1])) return;
        }
        std::size_t at = count_ - 1;
        for (; at != 0 && comes_before(contact, places_[at - 1]); --at) places_[at] = places_[at - 1];
        places_[at] = contact;
    }
    void set_full() { is_full_ = true; }
    [[nodiscard]] Filled result() const { return {count_, {}, is_full_ ? QueryStatus::output_full : QueryStatus::ok}; }

private:
    std::span<InScene<Contact>> places_;
    std::size_t count_ = 0;
    bool is_full_ = false;
};

/// Returns the box around all that may be within the margin of a body. The body is rounded twice, by its lattice and by
/// the kernel, so that it may be farther away than a shape that overlaps (docs/numerics.md, Scenes).
ShapeBounds bounds_with_margin(const SceneData& scene, ShapeBounds bounds, float margin) {
    const float parts[6] = {bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z};
    float reach = margin;
    for (const float part : parts) reach = maximum(absolute(part), reach);
    const float more = margin + (reach * 0x1p-15f + scene.coarsest_step * 0x1p-3f);
    bounds.low = {bounds.low.x - more, bounds.low.y - more, bounds.low.z - more};
    bounds.high = {bounds.high.x + more, bounds.high.y + more, bounds.high.z + more};
    return bounds;
}

/// A body of any type in world space, with its query of a blob. The search is compiled once: a copy for each type would
/// take 14 KB more of code.
struct AnyBody {
    const void* world;
    ShapeBounds bounds;
    bool has_finite_radius;
    ShapeBounds (*bounds_in)(const void* world, const Transform& tile);
    /// `tile` holds the instance, or is null.
    Filled (*find)(const void* world, const Transform* tile, const Transform& instance, const Blob& mesh, float margin,
                   std::span<Contact> contacts);

    template <class Body>
    explicit AnyBody(const Body& body)
        : world(&body),
          bounds(bounds_of(body)),
          has_finite_radius(detail::has_finite_radius(body)),
          bounds_in([](const void* from, const Transform& tile) {
              return bounds_of(LocalShape(tile, *static_cast<const Body*>(from)).shape());
          }),
          find([](const void* from, const Transform* tile, const Transform& instance, const Blob& mesh, float margin,
                  std::span<Contact> contacts) {
              const Body& in_world = *static_cast<const Body*>(from);
              if (tile == nullptr) return find_contacts(mesh, LocalShape(instance, in_world).shape(), margin, contacts);
              const LocalShape in_tile(*tile, in_world);
              return find_contacts(mesh, LocalShape<Body>(instance, in_tile.shape()).shape(), margin, contacts);
          }) {}
};

float length_to_local(const Transform& transform, float length) {
    return without_tiny(without_tiny(length) / transform.scale);
}

Contact in_world(const Transform& transform, Contact contact) {
    contact.point = to_world(transform, contact.point);
    contact.normal = normal_to_world(transform, contact.normal);
    contact.distance = without_tiny(without_tiny(contact.distance) * transform.scale);
    return contact;
}

/// A query: the contacts of a body with one instance after the other.
struct ContactSearch {
    const AnyBody& body;
    const SceneFilter& filter;
    std::span<Contact> room;
    DeepestContacts deepest;
    QueryStatus status = QueryStatus::ok;

    /// `tile` holds the instance, or is null.
    ESPALIER_NOINLINE Visit find(const VisitedInstance& instance, InstanceId id, float margin, const Transform* tile) {
        if (filter.keep() && !filter.keep()(id, no_triangle)) return Visit::next;
        const Filled found = body.find(body.world, tile, instance.transform, *instance.mesh,
                                       length_to_local(instance.transform, margin), room);
        status = status_in_scene(found.status);
        if (is_refused(status)) return Visit::stop;
        if (status == QueryStatus::output_full) deepest.set_full();
        for (std::size_t i = 0; i < found.count; ++i) {
            Contact contact = in_world(instance.transform, room[i]);
            if (tile != nullptr) contact = in_world(*tile, contact);
            deepest.add({contact, id});
        }
        return Visit::next;
    }
};

Filled find_in(const SceneView& scene, const AnyBody& body, float margin, std::span<InScene<Contact>> contacts,
               std::span<Contact> room, const SceneFilter& filter) {
    const bool is_sound =
        is_radius(margin) && is_finite(margin) && body.has_finite_radius && room.size() >= contacts.size();
    const QueryStatus status = !scene     ? refusal_of(scene)
                               : is_sound ? body.bounds.status
                                          : QueryStatus::invalid_argument;
    if (status != QueryStatus::ok) return {0, {}, of_list(status)};  // not_found: an empty hull
    ContactSearch search = {body, filter, room.first(contacts.size()), DeepestContacts(contacts)};
    const auto visit = [&](const VisitedInstance& instance, float&) {
        if (instance.mesh != nullptr) return search.find(instance, instance.id, margin, nullptr);
        const float reach = length_to_local(instance.transform, margin);
        const auto visit_inner = [&](const VisitedInstance& inner, float&) {
            return search.find(inner, instance.id_of(inner.id), reach, &instance.transform);
        };
        const ShapeBounds in_tile = body.bounds_in(body.world, instance.transform);
        return visit_meeting(*instance.tile, bounds_with_margin(data_of(*instance.tile), in_tile, reach), filter.mask(),
                             visit_inner);
    };
    visit_meeting(scene, bounds_with_margin(data_of(scene), body.bounds, margin), filter.mask(), visit);
    return is_refused(search.status) ? Filled{0, {}, search.status} : search.deepest.result();
}

}  // namespace

template <ContactBody Body>
Filled find_contacts(const SceneView& scene, const Body& body, float margin, std::span<InScene<Contact>> contacts,
                     std::span<Contact> room, const SceneFilter& filter) noexcept {
    return find_in(scene, AnyBody(body), margin, contacts, room, filter);
}
template Filled find_contacts(const SceneView&, const Sphere&, float, std::span<InScene<Contact>>, std::span<Contact>,
                              const SceneFilter&) noexcept;
template Filled find_contacts(const SceneView&, const Capsule&, float, std::span<InScene<Contact>>, std::span<Contact>,
                              const SceneFilter&) noexcept;
template Filled find_contacts(const SceneView&, const OrientedBox&, float, std::span<InScene<Contact>>,
                              std::span<Contact>, const SceneFilter&) noexcept;
template Filled find_contacts(const SceneView&, const ConvexHull&, float, std::span<InScene<Contact>>,
                              std::span<Contact>, const SceneFilter&) noexcept;

}  // namespace espalier
