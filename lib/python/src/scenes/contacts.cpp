// Contacts of bodies with all instances of a scene.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "flags.hpp"
#include "lists.hpp"
#include "scenes/held_moving.hpp"
#include "shapes/batches.hpp"

#include <algorithm>
#include <vector>

#include <espalier/scenes/contacts.hpp>

namespace espalier::python {

namespace {

using SceneContact = InScene<Contact>;

/// Appends the deepest contacts of a body with all instances.
template <class Scene, class Body>
QueryStatus append_deepest(const Scene& scene, const Body& body, float margin, std::size_t most,
                           const SceneFilter& filter, Growing<SceneContact>& all) {
    std::vector<SceneContact> contacts;
    std::vector<Contact> room;
    for (std::size_t places = std::min<std::size_t>(most, 64);; places = std::min(most, 4 * places)) {
        contacts.resize(places);
        room.resize(places);
        const Filled found = find_contacts(scene, body, margin, contacts, room, filter);
        if (found.status == QueryStatus::output_full && places < most) continue;
        for (const SceneContact& contact : found.in(contacts)) all.push(contact);
        return found.status;
    }
}

/// Returns (offsets, contacts, statuses).
template <class Scene>
py::tuple contact_lists(const Scene& self, const std::string& kind, const py::tuple& given, const py::handle& margin,
                        std::size_t most, std::uint32_t mask, const py::object& only, unsigned threads) {
    Floats margins(margin, "margin", {});
    const Flags flags(only);
    return list_for_shapes<SceneContact>(
        {kind, given, origin_of(self)}, &margins, dtype_of("scene_contact"), threads,
        [&](const auto& body, std::size_t i, Growing<SceneContact>& contacts) requires requires {
            find_contacts(Blob(), body, 0.0f, std::span<Contact>());
        } {
            return append_deepest(self.scene, body, margins.as<float>().at(i), most, flags.of_instances(mask),
                                  contacts);
        },
        reading(self));
}

}  // namespace

void bind_scene_contacts(py::module_& module) {
    module.def("scene_contact_lists", contact_lists<HeldScene>);
    module.def("scene_contact_lists", contact_lists<HeldMovingScene>);
}

}  // namespace espalier::python
