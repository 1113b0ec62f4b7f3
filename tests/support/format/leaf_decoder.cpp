#include "leaf_decoder.hpp"

#include <algorithm>

namespace espalier::tests::decoding {

namespace {

/// `width` bits for each vertex, counted from the low corner of the leaf's box; returns where the stream ends.
std::size_t read_axis(const Bytes& bytes, const Leaf& leaf, std::size_t at, unsigned axis, unsigned width,
                      std::vector<GridPoint>& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i][axis] = leaf.box.low[axis] + static_cast<std::int32_t>(bytes.field(at, i * width, width));
    }
    return at + (vertices.size() * width + 7) / 8;
}

/// The triangles of a strip whose entries name these vertices.
std::vector<GridTriangle> windows_of(const std::vector<std::uint32_t>& numbers, const std::vector<bool>& is_pivot,
                                     const std::vector<bool>& is_triangle, const std::vector<GridPoint>& vertices) {
    std::vector<GridTriangle> triangles;
    unsigned pivot = 0, pivots_so_far = 0;
    for (unsigned window = 0; window < numbers.size() - 2; ++window) {
        if (is_pivot[window]) {
            pivot = window;
            ++pivots_so_far;
        }
        if (!is_triangle[window]) continue;
        const GridPoint& first = vertices[numbers[pivot]];
        const GridPoint& before = vertices[numbers[window + 1]];
        const GridPoint& last = vertices[numbers[window + 2]];
        if (pivots_so_far % 2 == 1) {
            triangles.push_back({first, before, last});
        } else {
            triangles.push_back({first, last, before});
        }
    }
    return triangles;
}

}  // namespace

PlainLeafContent read_plain_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits, const CornerRows* corner_rows) {
    namespace layout = format::plain_leaf;
    const std::size_t triangle_count = (leaf.descriptor >> layout::triangles_shift & 15u) + 1;
    std::vector<GridPoint> vertices((leaf.descriptor >> layout::vertices_shift & 31u) + 1);
    std::size_t at = leaf.at + 4;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (GridPoint& vertex : vertices) {
            vertex[axis] = static_cast<std::int32_t>(bytes.u16(at));
            at += 2;
        }
    const std::size_t corners =
        corner_rows == nullptr ? at : corner_rows->at + std::size_t{3} * bytes.u32(leaf.at + layout::first_at);
    if (corner_rows == nullptr) at += 3 * triangle_count;
    else if (corners + 3 * triangle_count > corner_rows->end)
        throw std::runtime_error("decoder: a leaf's corners are outside of their section");
    if (bits > 16) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (GridPoint& vertex : vertices) vertex[axis] += static_cast<std::int32_t>(bytes.u8(at++) * 65536);
    }
    std::int64_t size = 0;
    for (const GridPoint& a : vertices)
        for (const GridPoint& b : vertices)
            for (std::size_t axis = 0; axis < 3; ++axis) size = std::max(size, std::int64_t{a[axis]} - b[axis]);
    unsigned field = 0;
    for (const unsigned least = bits > 16 ? bits - 15 : 1; size >= std::int64_t{1} << (field + least);) ++field;
    if (field != (leaf.descriptor >> layout::size_shift & 15u))
        throw std::runtime_error("decoder: a leaf's size is another one than its descriptor says");
    PlainLeafContent content;
    content.vertex_count = static_cast<unsigned>(vertices.size());
    for (std::size_t i = 0; i < triangle_count; ++i) {
        std::array<std::uint32_t, 3> numbers{};
        for (std::size_t k = 0; k < 3; ++k) {
            numbers[k] = bytes.u8(corners + k * triangle_count + i);
            if (numbers[k] >= vertices.size())
                throw std::runtime_error("decoder: a triangle names no vertex of its leaf");
        }
        content.triangles.push_back({vertices[numbers[0]], vertices[numbers[1]], vertices[numbers[2]]});
        content.corners.push_back(numbers);
    }
    return content;
}

std::vector<GridTriangle> read_strip_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits) {
    const unsigned entry_count = (leaf.descriptor >> format::strip_leaf::entries_shift & 63u) + 3;
    std::size_t bit = 0;
    const auto take = [&](unsigned width) {
        const std::uint32_t value = bytes.field(leaf.at, bit, width);
        bit += width;
        return value;
    };
    std::vector<bool> is_pivot(entry_count, false);
    std::vector<bool> is_triangle(entry_count - 2, true);
    std::vector<bool> is_first_use(entry_count, true);
    is_pivot[0] = true;
    for (unsigned entry = 1; entry <= entry_count - 3; ++entry) is_pivot[entry] = take(1) != 0;
    for (unsigned window = 1; window <= entry_count - 3; ++window) is_triangle[window] = take(1) != 0;
    for (unsigned entry = 3; entry < entry_count; ++entry) is_first_use[entry] = take(1) != 0;

    std::uint32_t vertex_count = 0;
    for (const bool is_new : is_first_use) vertex_count += is_new ? 1 : 0;
    std::vector<std::uint32_t> numbers;
    std::uint32_t used = 0;
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        numbers.push_back(is_first_use[entry] ? used++ : take(bits_of(vertex_count - 1)));
        if (numbers.back() >= used) throw std::runtime_error("decoder: an entry names a vertex before its first use");
    }

    std::vector<GridPoint> vertices(vertex_count);
    std::size_t at = leaf.at + (bit + 7) / 8;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto side = static_cast<std::uint32_t>(leaf.box.high[axis] - leaf.box.low[axis]);
        at = read_axis(bytes, leaf, at, axis, std::min(bits_of(side), bits), vertices);
    }

    return windows_of(numbers, is_pivot, is_triangle, vertices);
}

PredictedLeaf read_predicted_strip(const Bytes& bytes, const Leaf& leaf, unsigned bits) {
    const unsigned entry_count = (leaf.descriptor >> 10) + 3;
    std::size_t bit = 0;
    const auto take = [&](unsigned width) {
        const std::uint32_t value = bytes.field(leaf.at, bit, width);
        bit += width;
        return value;
    };
    std::array<std::array<unsigned, 2>, 3> width{};
    for (auto& [large, small] : width) {
        large = take(5);
        small = take(5);
    }
    const std::uint32_t joints = take(4);
    std::vector<bool> is_pivot(entry_count, false);
    std::vector<bool> is_triangle(entry_count - 2, true);
    std::vector<bool> is_first_use(entry_count, true);
    is_pivot[0] = true;
    for (unsigned entry = 1; entry <= entry_count - 3; ++entry) is_pivot[entry] = take(1) != 0;
    for (unsigned entry = 3; entry < entry_count; ++entry) is_first_use[entry] = take(1) != 0;
    for (std::uint32_t joint = 0; joint < joints; ++joint) {
        const std::uint32_t window = take(6);
        if (window == 0 || window + 5 > entry_count) throw std::runtime_error("decoder: a joint outside of its strip");
        is_triangle[window] = is_triangle[window + 1] = false;
    }
    const auto vertex_count = static_cast<std::uint32_t>(std::count(is_first_use.begin(), is_first_use.end(), true));
    std::vector<std::uint32_t> numbers;
    std::uint32_t used = 0;
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        numbers.push_back(is_first_use[entry] ? used++ : take(bits_of(vertex_count - 1)));
        if (numbers.back() >= used) throw std::runtime_error("decoder: an entry names a vertex before its first use");
    }
    const auto is_predicted = [&](unsigned entry) {
        return entry > 2 && is_triangle[entry - 2] && is_triangle[entry - 3];
    };
    std::vector<std::array<bool, 3>> is_large(entry_count);
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        if (!is_first_use[entry] || !is_predicted(entry)) continue;
        for (bool& large : is_large[entry]) large = take(1) != 0;
    }
    std::vector<GridPoint> vertices(vertex_count);
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        if (!is_first_use[entry]) continue;
        GridPoint& vertex = vertices[numbers[entry]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!is_predicted(entry)) {
                const auto side = static_cast<std::uint32_t>(leaf.box.high[axis] - leaf.box.low[axis]);
                vertex[axis] = leaf.box.low[axis] + static_cast<std::int32_t>(take(std::min(bits_of(side), bits)));
                continue;
            }
            const auto pivot_up_to = [&](unsigned window) {
                while (!is_pivot[window]) --window;
                return window;
            };
            const auto at = [&](unsigned place) { return vertices[numbers[place]][axis]; };
            const unsigned field = width[axis][is_large[entry][axis] ? 0 : 1];
            const auto residual = static_cast<std::int32_t>(take(field)) - (field == 0 ? 0 : 1 << (field - 1));
            const std::int32_t opposite = at(is_pivot[entry - 2] ? pivot_up_to(entry - 3) : entry - 2);
            vertex[axis] = at(pivot_up_to(entry - 2)) + at(entry - 1) - opposite + residual;
        }
    }
    return {windows_of(numbers, is_pivot, is_triangle, vertices), (bit + 7) / 8};
}

}  // namespace espalier::tests::decoding
