#include "image.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

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

void for_each_row(unsigned rows, unsigned threads, const std::function<void(unsigned)>& row,
                  const std::function<void(double)>& done) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    threads = std::clamp(threads, 1u, std::max(1u, rows));
    std::atomic<unsigned> next{0};
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threads; ++i) {
        helpers.emplace_back([&] {
            for (unsigned number = next++; number < rows; number = next++) row(number);
        });
    }
    for (unsigned number = next++; number < rows; number = next++) {
        row(number);
        done(static_cast<double>(number) / rows);
    }
}

}  // namespace espalier::tools
