// The blob, baked by the host and linked into the image, at an odd address on purpose: nothing may ask for alignment.
#pragma once

#include <cstddef>
#include <span>

extern "C" {
extern const std::byte firmware_blob[];
extern const std::byte firmware_blob_end[];
}

namespace espalier::firmware {

inline std::span<const std::byte> blob_in_image() { return {firmware_blob, firmware_blob_end}; }

}  // namespace espalier::firmware
