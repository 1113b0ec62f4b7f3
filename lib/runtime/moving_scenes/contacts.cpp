// Contacts of a body with the instances of a moving scene.
#include <espalier/scenes/contacts.hpp>
#include <runtime/moving_scenes/queries.hpp>

namespace espalier {

using detail::MovingSceneQuery;

#define ESPALIER_FIND_IN_MOVING_SCENE(Body)                                                          \
    Filled find_contacts(const MovingScene& scene, const Body& body, float margin,                   \
                         std::span<InScene<Contact>> contacts, std::span<Contact> room,              \
                         const SceneFilter& filter) noexcept {                                       \
        return find_contacts(MovingSceneQuery(scene).scene(), body, margin, contacts, room, filter); \
    }
ESPALIER_FIND_IN_MOVING_SCENE(Sphere)
ESPALIER_FIND_IN_MOVING_SCENE(Capsule)
ESPALIER_FIND_IN_MOVING_SCENE(OrientedBox)
ESPALIER_FIND_IN_MOVING_SCENE(ConvexHull)
#undef ESPALIER_FIND_IN_MOVING_SCENE

}  // namespace espalier
