// Which triangles of a leaf a ray may hit, on small cores: those that are not clearly beside it as seen along it
// (seen_ray.hpp).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <runtime/bytes.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/seen_ray.hpp>

namespace espalier::detail {

/// Two signed numbers of 16 bits.
using SeenVertex = std::uint32_t;

inline std::int32_t cross(SeenVertex p, SeenVertex q) {
    const auto x = [](SeenVertex pair) { return std::int32_t{static_cast<std::int16_t>(pair)}; };
    const auto y = [](SeenVertex pair) { return static_cast<std::int32_t>(pair) >> 16; };
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x(p) * y(q)) - static_cast<std::uint32_t>(y(p) * x(q)));
}

/// A leaf's vertices as seen along a ray.
template <unsigned max_vertices>
struct SeenVertices {
    SeenVertex vertex[max_vertices];
    std::int32_t error;  ///< of the edge functions of a triangle that is hit

    template <class Leaf>
    [[gnu::always_inline]] SeenVertices(const Leaf& leaf, const SeenRay& ray) {
        const int width = leaf.size == 1 ? 1 : static_cast<int>(std::bit_width(leaf.size)) - 1;
        const int fine = 29 - width;                        // the leaf measures 2^29 at most: 2^13 in what is kept
        const auto corner_of = [&](const SeenAxis& axis) {  // in units of 2^-fraction_bits
            const std::uint32_t corner = (static_cast<std::uint32_t>(leaf.anchor(axis.axis)) << ray.fraction_bits) -
                                         static_cast<std::uint32_t>(ray.origin[axis.axis]);
            return static_cast<std::int32_t>(axis.runs_down() ? 0u - corner : corner);
        };
        const SeenAxis& forth = ray.seen[2];
        const std::int32_t start = corner_of(forth);
        for (unsigned i = 0; i < 2; ++i) {
            const SeenAxis& axis = ray.seen[i];
            const std::int32_t seen = axis.across(corner_of(axis), start);
            const int finer = fine - ray.fraction_bits;  // -1 only where a leaf's fields are wider than its asset
            std::uint32_t corner =
                finer < 0 ? static_cast<std::uint32_t>(seen >> 1) : static_cast<std::uint32_t>(seen) << finer;
            corner += 1u << 15;  // half of what is cut off
            const std::uint32_t across = axis.runs_down() ? 0u - (1u << fine) : 1u << fine;
            auto ahead = static_cast<std::uint32_t>((axis.slope + (1 << width >> 2)) >> (width - 1));
            if (!forth.runs_down()) ahead = 0u - ahead;
            for (unsigned v = 0; v < leaf.vertex_count; ++v) {
                const auto field = [&](const SeenAxis& of) {
                    return load_field(leaf.coordinates[of.axis], leaf.width[of.axis], v);
                };
                const std::uint32_t place = corner + across * field(axis) + ahead * field(forth);
                vertex[v] = i == 0 ? place >> 16 : vertex[v] | (place & 0xFFFF0000u);
            }
        }
        // What one coordinate of a triangle that is hit is off by: it is within 2^14.
        const std::int32_t off = 1 + (1 << width >> 15) + ((1 << 16) >> (width + ray.fraction_bits));
        error = off < 1 << 12 ? off * ((1 << 16) + 6 * off) : 0x7FFFFFFF;
    }
    [[nodiscard]] bool allows(unsigned a, unsigned b, unsigned c) const {
        const std::int32_t u = cross(vertex[b], vertex[c]);
        const std::int32_t v = cross(vertex[c], vertex[a]);
        const std::int32_t w = cross(vertex[a], vertex[b]);
        return (u >= -error && v >= -error && w >= -error) || (u <= error && v <= error && w <= error);
    }
};

}  // namespace espalier::detail
