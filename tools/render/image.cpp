#include "image.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

std::uint8_t encoded(float light) {
    const float value = std::clamp(light, 0.0f, 1.0f);
    const float curved = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255.0f * curved));
}

}  // namespace

Colour operator+(Colour a, Colour b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
Colour operator*(float factor, Colour colour) {
    return {factor * colour.red, factor * colour.green, factor * colour.blue};
}
Colour mix(Colour a, Colour b, float share_of_b) { return (1.0f - share_of_b) * a + share_of_b * b; }

Image::Image(unsigned width, unsigned height)
    : width_(width), height_(height), pixels_(std::size_t{3} * width * height) {}

void Image::set(unsigned column, unsigned row, Colour colour) {
    std::uint8_t* pixel = pixels_.data() + std::size_t{3} * (std::size_t{row} * width_ + column);
    pixel[0] = encoded(colour.red);
    pixel[1] = encoded(colour.green);
    pixel[2] = encoded(colour.blue);
}

std::vector<std::byte> Image::png() const {
    png_image description{};
    description.version = PNG_IMAGE_VERSION;
    description.width = width_;
    description.height = height_;
    description.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&description, bytes.data(), &size, 0, pixels_.data(), 0, nullptr) == 0) {
        throw CommandError(ExitCode::internal,
                           text("the picture could not be made into a PNG: ", description.message, '.'));
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace espalier::tools
