// The fields of a header, of a blob or a scene, with their meaning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "byte_listing.hpp"

namespace espalier::tools {

struct HeaderField {
    std::size_t at;
    std::size_t bytes;
    const char* name;
    enum class Kind : std::uint8_t { integer, signed_integer, real, hexadecimal, text, vector, point, zero } kind;
};

/// Lists the header at the beginning of the bytes, as far as there are bytes: a refused blob may end within it.
void list_header(std::span<const std::byte> bytes, std::span<const HeaderField> fields, ByteListing& listing);

}  // namespace espalier::tools
