#include <baker/build/morton_order.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace espalier::baker {

namespace {

constexpr unsigned bits_per_axis = 21;

/// Bit i of the value at bit 3i.
std::uint64_t spread_out(std::uint64_t value) {
    value = (value | value << 32) & 0x001F00000000FFFFu;
    value = (value | value << 16) & 0x001F0000FF0000FFu;
    value = (value | value << 8) & 0x100F00F00F00F00Fu;
    value = (value | value << 4) & 0x10C30C30C30C30C3u;
    value = (value | value << 2) & 0x1249249249249249u;
    return value;
}

std::uint64_t twice_the_center(std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto [low, high] = std::minmax({a, b, c});
    return static_cast<std::uint64_t>(low) + static_cast<std::uint64_t>(high);
}

using Center = std::array<std::uint64_t, 3>;

Center twice_the_center(const LatticeMesh& mesh, std::uint32_t triangle) {
    const auto& corners = mesh.triangles[triangle].corners;
    const LatticePoint& a = mesh.vertices[corners[0]];
    const LatticePoint& b = mesh.vertices[corners[1]];
    const LatticePoint& c = mesh.vertices[corners[2]];
    return {twice_the_center(a.x, b.x, c.x), twice_the_center(a.y, b.y, c.y), twice_the_center(a.z, b.z, c.z)};
}

}  // namespace

std::vector<MortonEntry> morton_order(const LatticeMesh& mesh) {
    std::vector<MortonEntry> entries(mesh.triangles.size());
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        const auto [x, y, z] = twice_the_center(mesh, i);
        largest = std::max({largest, x, y, z});
    }
    const auto used_bits = static_cast<unsigned>(std::bit_width(largest));
    const unsigned dropped_bits = used_bits > bits_per_axis ? used_bits - bits_per_axis : 0;
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        const auto [x, y, z] = twice_the_center(mesh, i);
        entries[i] = {
            spread_out(x >> dropped_bits) << 2 | spread_out(y >> dropped_bits) << 1 | spread_out(z >> dropped_bits), i};
    }
    std::sort(entries.begin(), entries.end(), [](const MortonEntry& a, const MortonEntry& b) {
        return a.code != b.code ? a.code < b.code : a.triangle < b.triangle;
    });
    return entries;
}

std::uint32_t morton_split(std::span<const MortonEntry> entries) {
    const std::uint64_t different = entries.front().code ^ entries.back().code;
    if (different == 0) return static_cast<std::uint32_t>(entries.size() / 2);
    const std::uint64_t highest = std::bit_floor(different);
    const auto middle = std::partition_point(entries.begin(), entries.end(),
                                             [&](const MortonEntry& entry) { return (entry.code & highest) == 0; });
    return static_cast<std::uint32_t>(middle - entries.begin());
}

}  // namespace espalier::baker
