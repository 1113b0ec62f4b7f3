// The blob, baked by the host and linked into the image, at an odd address on purpose: nothing may ask for alignment.
#pragma once

#include <cstddef>
#include <span>

namespace espalier::firmware {

alignas(4) inline constexpr unsigned char odd_then_blob[] = {
    0,
#include ESPALIER_BLOB
};

inline std::span<const std::byte> blob_in_flash() { return std::as_bytes(std::span(odd_then_blob)).subspan(1); }

}  // namespace espalier::firmware
