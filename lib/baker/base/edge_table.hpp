// The edges of triangles, those between the same two vertices together.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace espalier::baker {

/// One edge of one triangle: from corner `number` to the next.
struct TriangleEdge {
    std::uint32_t higher_vertex;
    std::uint32_t triangle;
    std::uint8_t number;
    bool ascends;  ///< from the lower vertex to the higher; false from a vertex to itself

    [[nodiscard]] auto place() const { return std::tuple(higher_vertex, triangle, number); }
};

class EdgeTable {
public:
    EdgeTable() = default;

    /// Sorts the edges of triangles 0 to `triangle_count` - 1. corners_of(triangle) returns the numbers of three
    /// vertices, each below `vertex_count`; they may be equal.
    template <class CornersOf>
    EdgeTable(std::uint32_t triangle_count, std::size_t vertex_count, CornersOf corners_of)
        : ends_(vertex_count + 1, 0), edges_(3 * std::size_t{triangle_count}) {
        // By their lower vertex edges are sorted by counting, and among those few by comparing.
        const auto for_each_edge = [&](auto visit) {
            for (std::uint32_t triangle = 0; triangle < triangle_count; ++triangle) {
                const std::array<std::uint32_t, 3>& corners = corners_of(triangle);
                for (std::uint8_t e = 0; e < 3; ++e) visit(triangle, e, corners[e], corners[(e + 1u) % 3u]);
            }
        };
        for_each_edge([&](std::uint32_t, std::uint8_t, std::uint32_t from, std::uint32_t to) {
            ++ends_[std::size_t{std::min(from, to)} + 1];
        });
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        // Each edge moves the start of its vertex one on, up to the start of the next one.
        for_each_edge([&](std::uint32_t triangle, std::uint8_t number, std::uint32_t from, std::uint32_t to) {
            edges_[ends_[std::min(from, to)]++] = {std::max(from, to), triangle, number, from < to};
        });
        for (std::size_t lower = 0; lower < ends_.size(); ++lower) {
            const auto [begin, end] = range_of(lower);
            std::ranges::sort(edges_.data() + begin, edges_.data() + end, {}, &TriangleEdge::place);
        }
    }

    /// Calls visit(lower_vertex, edges) for each two vertices with an edge between them. Vertices ascend, and so do the
    /// triangles of the edges, and the numbers within a triangle.
    template <class Visit>
    void for_each_pair(Visit visit) const {
        for (std::size_t lower = 0; lower < ends_.size(); ++lower) {
            auto [begin, end] = range_of(lower);
            while (begin != end) {
                std::size_t next = begin;
                while (next != end && edges_[next].higher_vertex == edges_[begin].higher_vertex) ++next;
                visit(static_cast<std::uint32_t>(lower), std::span(edges_).subspan(begin, next - begin));
                begin = next;
            }
        }
    }

    /// Tests whether an edge joins the two vertices, in either direction.
    [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const {
        const auto [begin, end] = range_of(std::min(a, b));
        return std::ranges::binary_search(edges_.data() + begin, edges_.data() + end, std::max(a, b), {},
                                          &TriangleEdge::higher_vertex);
    }

private:
    struct Range {
        std::size_t begin;
        std::size_t end;
    };
    [[nodiscard]] Range range_of(std::size_t lower) const { return {lower == 0 ? 0 : ends_[lower - 1], ends_[lower]}; }

    std::vector<std::size_t> ends_;  // of each vertex, where the edges that it is the lower vertex of end
    std::vector<TriangleEdge> edges_;
};

}  // namespace espalier::baker
