// espalier/c/abi.h: the version and the sizes of structures.
#include <runtime/c/abi.hpp>

namespace {

bool are_equal(const char* a, const char* b) {
    for (; *a == *b; ++a, ++b)
        if (*a == '\0') return true;
    return false;
}

#define NAME(structure, Cpp) #structure "\0"
constexpr char names[] = ESPALIER_C_STRUCTURES(NAME, NAME);
#define SIZE(structure, Cpp) sizeof(espalier_##structure),
constexpr std::uint16_t sizes[] = {ESPALIER_C_STRUCTURES(SIZE, SIZE)};
#undef NAME
#undef SIZE

}  // namespace

const char* espalier_version(void) { return ESPALIER_VERSION; }

size_t espalier_size_of(const char* name) {
    if (name == nullptr) return 0;
    const char* structure = names;
    for (const std::uint16_t size : sizes) {
        if (are_equal(name, structure)) return size;
        while (*structure++ != '\0') {
        }
    }
    return 0;
}

#define SIZE(name, Cpp) .name = sizeof(espalier_##name),

espalier_abi_sizes espalier_abi(void) {
    return {.version_major = ESPALIER_VERSION_MAJOR,
            .version_minor = ESPALIER_VERSION_MINOR,
            .version_patch = ESPALIER_VERSION_PATCH,
            ESPALIER_C_STRUCTURES(SIZE, SIZE)};
}
#undef SIZE
