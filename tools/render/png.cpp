#include <png.h>

#include "base/exit_code.hpp"
#include "shading.hpp"

namespace espalier::tools {

std::vector<std::byte> Image::png() const {
    png_image description{};
    description.version = PNG_IMAGE_VERSION;
    description.width = width_;
    description.height = height_;
    description.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&description, bytes.data(), &size, 0, pixels_.data(), 0, nullptr) == 0) {
        throw_error(ExitCode::internal, "the picture could not be made into a PNG: ", description.message, '.');
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace espalier::tools
