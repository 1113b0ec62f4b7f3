#include <baker/collapse/neighbours.hpp>

#include <algorithm>
#include <span>

#include <baker/base/edge_table.hpp>

namespace espalier::baker {

Neighbours::Neighbours(const LatticeMesh& mesh, const BinaryTree& tree)
    : across_(tree.triangles.size(), {none, none, none}) {
    const auto corners_at = [&](std::uint32_t place) -> const std::array<std::uint32_t, 3>& {
        return mesh.triangles[tree.triangles[place]].corners;
    };
    const EdgeTable table(static_cast<std::uint32_t>(tree.triangles.size()), mesh.vertices.size(), corners_at);
    table.for_each_pair([&](std::uint32_t, std::span<const TriangleEdge> edges) {
        auto up = edges.begin();
        auto down = edges.begin();
        for (;;) {
            up = std::find_if(up, edges.end(), [](const TriangleEdge& edge) { return edge.ascends; });
            down = std::find_if(down, edges.end(), [](const TriangleEdge& edge) { return !edge.ascends; });
            if (up == edges.end() || down == edges.end()) return;
            across_[up->triangle][up->number] = down->triangle;
            across_[down->triangle][down->number] = up->triangle;
            ++up;
            ++down;
        }
    });
}

}  // namespace espalier::baker
