#include "soundness.hpp"

#include <stdexcept>

namespace espalier::tests {

namespace {

bool has_area(const GridTriangle& triangle) {
    const auto edge = [&](const GridPoint& to, std::size_t k) { return std::int64_t{to[k]} - triangle.a[k]; };
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (edge(triangle.b, k) * edge(triangle.c, next) != edge(triangle.b, next) * edge(triangle.c, k)) return true;
    }
    return false;
}

bool holds(const GridBox& box, const GridPoint& point) {
    for (std::size_t k = 0; k < 3; ++k)
        if (point[k] < box.low[k] || point[k] > box.high[k]) return false;
    return true;
}

/// The boxes on the way down to a node: what is below it must be in all of them, so in what they share.
GridBox shared(const GridBox& a, const GridBox& b) {
    GridBox result = a;
    for (std::size_t k = 0; k < 3; ++k) {
        if (b.low[k] > result.low[k]) result.low[k] = b.low[k];
        if (b.high[k] < result.high[k]) result.high[k] = b.high[k];
    }
    return result;
}

}  // namespace

bool boxes_end_near_asset(const DecodedBlob& decoded) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t extent = decoded.extent[k];
        std::int64_t end = 0;
        if (decoded.profile == Profile::fast) {
            const std::int64_t unit = decoded.bits > 16 ? std::int64_t{1} << (decoded.bits - 16) : 1;
            end = (extent / unit + 1) * unit;
        } else {
            std::int64_t spacing = 1;  // of the finest 256 planes from 0 that reach the extent
            while (spacing * 255 < extent) spacing *= 2;
            end = extent + spacing;
        }
        for (const DecodedNode& node : decoded.nodes)
            for (const DecodedChild& child : node.children)
                if (child.box.high[k] >= end) return false;
    }
    return true;
}

bool is_sound(const DecodedBlob& decoded) {
    if (!boxes_end_near_asset(decoded)) return false;
    const bool may_be_flat = (decoded.features & format::feature::deformable) != 0;
    for (const GridTriangle& triangle : decoded.triangles)
        if (!may_be_flat && !has_area(triangle)) return false;
    if ((decoded.features & format::feature::split_references) != 0) return false;  // parts of triangles in boxes
    constexpr std::int32_t everything = 0x7FFFFFFF;
    std::vector<GridBox> around(decoded.nodes.size());
    if (!around.empty()) around[0] = {{0, 0, 0}, {everything, everything, everything}};
    for (std::size_t node = 0; node < decoded.nodes.size(); ++node) {  // children come after their parents
        for (const DecodedChild& child : decoded.nodes[node].children) {
            const GridBox box = shared(around[node], child.box);
            if (child.is_node) around[child.node] = box;
            for (std::uint32_t i = 0; !child.is_node && i < child.triangle_count; ++i) {
                const GridTriangle& triangle = decoded.triangles[child.first_triangle + i];
                if (!holds(box, triangle.a) || !holds(box, triangle.b) || !holds(box, triangle.c)) return false;
            }
        }
    }
    return true;
}

bool is_sound(std::span<const std::byte> blob) {
    try {
        return is_sound(decode(blob));
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace espalier::tests
