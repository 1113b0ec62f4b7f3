// espalier/c/contact.h: contacts of a body.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

static_assert(espalier::max_reduced_contacts == ESPALIER_MAX_REDUCED_CONTACTS);

#define FIND_CONTACTS(name)                                                                       \
    ESPALIER_C_FUNCTION(espalier_find_contacts_##name, (blob, shape, margin, contacts, capacity), \
                        c(find_contacts(cpp(blob), cpp(shape), margin, cpp(contacts, capacity))))

ESPALIER_C_CONTACT_BODIES(FIND_CONTACTS)

ESPALIER_C_FUNCTION(espalier_reduce_contacts, (contacts, count), espalier::reduce_contacts(cpp(contacts, count)))
ESPALIER_C_FUNCTION(espalier_collect_planes, (blob, capsule, margin, planes, capacity),
                    c(collect_planes(cpp(blob), cpp(capsule), margin, cpp(planes, capacity))))

ESPALIER_C_FUNCTION(espalier_solve_planes, (planes, count, wish, skin),
                    c(espalier::solve_planes(cpp(planes, count), cpp(wish), skin)))
