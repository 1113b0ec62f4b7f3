// espalier/c/scenes/contacts.h: contacts of a body with all instances of a scene.
#include <runtime/c/abi.hpp>
#include <runtime/c/scene_arguments.hpp>

using namespace espalier::detail;

#define SCENE_CONTACTS(name)                                                                                       \
    espalier_filled espalier_scene_find_contacts_##name(                                                           \
        const espalier_scene* scene, const espalier_##name* shape, float margin, espalier_scene_contact* contacts, \
        espalier_contact* room, size_t capacity, uint32_t mask, espalier_scene_filter filter, void* user) {        \
        return c(find_contacts(cpp(scene), cpp(shape), margin, cpp(contacts, capacity), cpp(room, capacity),       \
                               Selection(mask, filter, user)));                                                    \
    }

SCENE_CONTACTS(sphere)
SCENE_CONTACTS(capsule)
SCENE_CONTACTS(oriented_box)
SCENE_CONTACTS(convex_hull)
