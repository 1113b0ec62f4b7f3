// espalier/c/contact.h: contacts of a body, and what the edges of triangles are.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

static_assert(espalier::max_reduced_contacts == ESPALIER_MAX_REDUCED_CONTACTS);

#define FIND_CONTACTS(name)                                                                                    \
    espalier_filled espalier_find_contacts_##name(const espalier_blob* blob, const espalier_##name* shape,     \
                                                  float margin, espalier_contact* contacts, size_t capacity) { \
        return c(find_contacts(cpp(blob), cpp(shape), margin, cpp(contacts, capacity)));                       \
    }

FIND_CONTACTS(sphere)
FIND_CONTACTS(capsule)
FIND_CONTACTS(oriented_box)
FIND_CONTACTS(convex_hull)

size_t espalier_reduce_contacts(espalier_contact* contacts, size_t count) {
    return espalier::reduce_contacts(cpp(contacts, count));
}
