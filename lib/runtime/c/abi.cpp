// espalier/c/abi.h: the version and the sizes of structures.
#include <runtime/c/abi.hpp>

namespace {

bool are_equal(const char* a, const char* b) {
    for (; *a == *b; ++a, ++b)
        if (*a == '\0') return true;
    return false;
}

}  // namespace

const char* espalier_version(void) { return ESPALIER_VERSION; }

#define SIZE_IF_NAMED(structure, Cpp) \
    if (are_equal(name, #structure)) return sizeof(espalier_##structure);

size_t espalier_size_of(const char* name) {
    if (name == nullptr) return 0;
    ESPALIER_C_STRUCTURES(SIZE_IF_NAMED, SIZE_IF_NAMED)
    return 0;
}

#define SIZE(name, Cpp) .name = sizeof(espalier_##name),

espalier_abi_sizes espalier_abi(void) {
    return {.version_major = ESPALIER_VERSION_MAJOR,
            .version_minor = ESPALIER_VERSION_MINOR,
            .version_patch = ESPALIER_VERSION_PATCH,
            ESPALIER_C_STRUCTURES(SIZE, SIZE)};
}
