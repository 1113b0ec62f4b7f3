// Structures that a caller in C fills in. They begin with their size, so that later versions can append fields.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>

#include <espalier/espalier.hpp>

namespace espalier::baker {

/// Writes the defaults to a structure of `size` bytes; zeros to those that this version does not have.
template <class Structure>
void write_defaults(void* place, std::size_t size, Structure defaults) {
    if (place == nullptr) return;
    defaults.size = size;
    std::memset(place, 0, size);
    std::memcpy(place, &defaults, std::min(size, sizeof defaults));
}

/// Reads a structure over the defaults, which the fields keep that an older caller does not have. Returns what is wrong
/// with its size. `first_size` is the size of the first version.
template <class Structure>
std::optional<std::string> read_structure(const void* place, std::size_t first_size, const char* name,
                                          Structure& structure) {
    std::size_t size = 0;
    std::memcpy(&size, place, sizeof size);
    const auto complaint = [&](const char* reason) {
        return std::string(name) + " has the size " + std::to_string(size) + reason;
    };
    if (size < first_size) return complaint(", which no version has; begin with its function espalier_init_");
    if (size > sizeof structure)
        return complaint(" of a newer version; compile the program with the headers of Espalier ") + library_version;
    std::memcpy(&structure, place, size);
    return std::nullopt;
}

}  // namespace espalier::baker
