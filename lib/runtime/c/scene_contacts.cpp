// espalier/c/scenes/contacts.h: contacts of a body with all instances of a scene.
#include <runtime/c/scene_arguments.hpp>

using namespace espalier::detail;

#define SCENE_CONTACTS(name)                                                                                          \
    ESPALIER_C_FUNCTION(espalier_scene_find_contacts_##name,                                                          \
                        (scene, shape, margin, contacts, room, capacity, mask, filter, user),                         \
                        c(find_contacts(cpp(scene), cpp(shape), margin, cpp(contacts, capacity), cpp(room, capacity), \
                                        Selection(mask, filter, user))))

ESPALIER_C_CONTACT_BODIES(SCENE_CONTACTS)
