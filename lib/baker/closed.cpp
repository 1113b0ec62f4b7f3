#include "closed.hpp"

#include <algorithm>
#include <vector>

#include "insertion_table.hpp"

namespace espalier::baker {

namespace {

/// Calls visit(from, to) for every directed edge.
template <class Visit>
void for_each_edge(const LatticeMesh& mesh, Visit visit) {
    for (const LatticeTriangle& triangle : mesh.triangles) {
        const auto [a, b, c] = triangle.corners;
        visit(a, b);
        visit(b, c);
        visit(c, a);
    }
}

/// Edges that pair up in opposite directions cancel in this sum. One that is not zero proves that some do not: the
/// cheap answer for almost every open mesh.
bool edges_may_cancel(const LatticeMesh& mesh) {
    std::uint64_t sum = 0;
    for_each_edge(mesh, [&](std::uint32_t from, std::uint32_t to) {
        const auto low = from < to ? from : to;
        const auto high = from < to ? to : from;
        const std::uint64_t hash = mix_bits(std::uint64_t{low} << 32 | high);
        sum += from < to ? hash : std::uint64_t{0} - hash;
    });
    return sum == 0;
}

}  // namespace

bool is_closed(const LatticeMesh& mesh) {
    if (mesh.triangles.empty() || !edges_may_cancel(mesh)) return false;
    // Edges sorted by their lower vertex (counting), then by the higher one and the direction: pairs become neighbours.
    std::vector<std::uint32_t> first(mesh.vertices.size() + 1, 0);
    for_each_edge(mesh, [&](std::uint32_t from, std::uint32_t to) { ++first[(from < to ? from : to) + 1]; });
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<std::uint64_t> edges(mesh.triangles.size() * 3);
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for_each_edge(mesh, [&](std::uint32_t from, std::uint32_t to) {
        const bool is_upward = from < to;
        edges[next[is_upward ? from : to]++] = std::uint64_t{is_upward ? to : from} << 1 | (is_upward ? 1 : 0);
    });
    for (std::size_t vertex = 0; vertex + 1 < first.size(); ++vertex) {
        const auto begin = edges.begin() + first[vertex];
        const auto end = edges.begin() + first[vertex + 1];
        if ((end - begin) % 2 != 0) return false;
        std::sort(begin, end);
        for (auto edge = begin; edge != end; edge += 2) {
            // Of more than two uses, or two in one direction, two equal ones come first.
            const bool is_pair = edge[1] == edge[0] + 1 && (edge[0] & 1) == 0;
            if (!is_pair) return false;
        }
    }
    return true;
}

}  // namespace espalier::baker
