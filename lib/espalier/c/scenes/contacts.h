/* Contacts of a body with all instances of a scene, baked or moving. Counterpart of scenes/contacts.hpp. */
#ifndef ESPALIER_C_SCENES_CONTACTS_H
#define ESPALIER_C_SCENES_CONTACTS_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/contact.h>
#include <espalier/c/scene.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A contact with a blob, in world space, and the instance. */
typedef struct ESPALIER_SHARED_ espalier_scene_contact {
    espalier_contact hit;
    espalier_instance_id instance;
} espalier_scene_contact;

/* Write the contacts with all instances, the deepest first, up to `capacity`. `room` is scratch memory of the same
 * capacity for the contacts of one instance. `filter` is called once for each instance near the body, with
 * ESPALIER_NO_TRIANGLE. A view of a moving scene is accepted too. */
espalier_filled espalier_scene_find_contacts_sphere(const espalier_scene* scene, const espalier_sphere* sphere,
                                                    float margin, espalier_scene_contact* contacts,
                                                    espalier_contact* room, size_t capacity, uint32_t mask,
                                                    espalier_scene_filter filter, void* user);
espalier_filled espalier_scene_find_contacts_capsule(const espalier_scene* scene, const espalier_capsule* capsule,
                                                     float margin, espalier_scene_contact* contacts,
                                                     espalier_contact* room, size_t capacity, uint32_t mask,
                                                     espalier_scene_filter filter, void* user);
espalier_filled espalier_scene_find_contacts_oriented_box(const espalier_scene* scene, const espalier_oriented_box* box,
                                                          float margin, espalier_scene_contact* contacts,
                                                          espalier_contact* room, size_t capacity, uint32_t mask,
                                                          espalier_scene_filter filter, void* user);
espalier_filled espalier_scene_find_contacts_convex_hull(const espalier_scene* scene, const espalier_convex_hull* hull,
                                                         float margin, espalier_scene_contact* contacts,
                                                         espalier_contact* room, size_t capacity, uint32_t mask,
                                                         espalier_scene_filter filter, void* user);

#ifdef __cplusplus
}
#endif

#endif
