#include "cloth.hpp"

#include "vector.hpp"

namespace flag {

namespace {

constexpr std::int32_t columns = 72, rows = 48;  // of squares
constexpr std::int32_t length = 3 * metre, height = 2 * metre;
constexpr std::int32_t top = 7 * metre / 2;
constexpr std::int32_t one = 1 << 12;   // of sines and shares
constexpr std::int32_t turn = 1 << 16;  // of angles
constexpr std::uint32_t steps_between_gusts = 256;

/// Returns the sine, within two thousandths (Bhaskara I).
std::int32_t sine(std::int32_t angle) {
    const std::int64_t whole = angle & (turn - 1), half = turn / 2;
    const std::int64_t x = whole % half, product = x * (half - x);
    const auto value = static_cast<std::int32_t>(16 * product * one / (5 * half * half - 4 * product));
    return whole < half ? value : -value;
}

/// Returns the strength of the wind: a breeze of a quarter, and gusts of one.
std::int32_t wind_at(std::uint32_t step) {
    const auto angle = static_cast<std::int32_t>(step % steps_between_gusts * (turn / steps_between_gusts));
    return (5 * one - 3 * sine(angle + turn / 4)) / 8;
}

/// Returns a share of a length; one is 2^12.
std::int32_t share_of(std::int64_t whole, std::int64_t share) { return static_cast<std::int32_t>(whole * share / one); }

/// Returns where the vertex is that lies `along` from the pole and `down` from the top of the cloth.
Vector place_vertex(std::int32_t along, std::int32_t down, std::uint32_t step) {
    const std::int32_t wind = wind_at(step);
    const auto time = static_cast<std::int32_t>(step * (turn / 128));
    // Waves run along the cloth. They are deeper far from the pole, and in a gust.
    const std::int32_t free_share = along * one / length;
    const std::int32_t depth = share_of(share_of(5 * metre / 8, free_share), (one + wind) / 2);
    const std::int32_t wave = sine(8 * along + down - time) + sine(17 * along - 3 * down - 2 * time) / 6;
    // In a breeze the free end hangs down.
    const std::int32_t sag = share_of(share_of(one - wind, along / 2), (one + free_share) / 2);
    return {along - share_of(depth, free_share) / 2 - sag / 4, share_of(depth, wave), top - down - sag};
}

}  // namespace

std::vector<espalier::TriangleVertices> cloth_triangles() {
    std::vector<espalier::TriangleVertices> triangles;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * (columns + 1) + column, b = a + columns + 1;
            triangles.push_back({a, b, b + 1});
            triangles.push_back({a, b + 1, a + 1});
        }
    return triangles;
}

void move_cloth(std::uint32_t step, std::vector<espalier::Vec3>& positions) {
    positions.clear();
    for (std::int32_t row = 0; row <= rows; ++row)
        for (std::int32_t column = 0; column <= columns; ++column)
            positions.push_back(in_metres(place_vertex(column * length / columns, row * height / rows, step)));
}

}  // namespace flag
