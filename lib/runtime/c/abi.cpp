// espalier/c/abi.h: the version and the sizes of structures.
#include <runtime/c/abi.hpp>

#define SIZE(name, Cpp) .name = sizeof(espalier_##name),

espalier_abi_sizes espalier_abi(void) {
    return {.version_major = ESPALIER_VERSION_MAJOR,
            .version_minor = ESPALIER_VERSION_MINOR,
            .version_patch = ESPALIER_VERSION_PATCH,
            ESPALIER_C_STRUCTURES(SIZE, SIZE)};
}
