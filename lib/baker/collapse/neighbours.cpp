#include <baker/collapse/neighbours.hpp>

#include <algorithm>

namespace espalier::baker {

namespace {

/// One edge of one triangle, kept with its lower vertex.
struct Edge {
    std::uint32_t higher_vertex;
    std::uint32_t place;
    std::uint8_t number;
    bool ascends;  ///< from the lower vertex to the higher
};

bool comes_before(const Edge& a, const Edge& b) {
    if (a.higher_vertex != b.higher_vertex) return a.higher_vertex < b.higher_vertex;
    if (a.place != b.place) return a.place < b.place;
    return a.number < b.number;
}

}  // namespace

Neighbours::Neighbours(const LatticeMesh& mesh, const BinaryTree& tree)
    : across_(tree.triangles.size(), {none, none, none}) {
    const auto corners_at = [&](std::size_t place) -> const std::array<std::uint32_t, 3>& {
        return mesh.triangles[tree.triangles[place]].corners;
    };
    // Edges are sorted by their lower vertex by counting, and among those few by comparing.
    std::vector<std::uint32_t> ends(mesh.vertices.size() + 1, 0);
    for (std::size_t place = 0; place < tree.triangles.size(); ++place) {
        const auto& corners = corners_at(place);
        for (std::size_t e = 0; e < 3; ++e) ++ends[std::min(corners[e], corners[(e + 1) % 3]) + 1];
    }
    for (std::size_t vertex = 1; vertex < ends.size(); ++vertex) ends[vertex] += ends[vertex - 1];
    std::vector<Edge> edges(3 * tree.triangles.size());
    for (std::uint32_t place = 0; place < tree.triangles.size(); ++place) {
        const auto& corners = corners_at(place);
        for (std::uint8_t e = 0; e < 3; ++e) {
            const std::uint32_t from = corners[e];
            const std::uint32_t to = corners[(e + 1u) % 3u];
            edges[ends[std::min(from, to)]++] = {std::max(from, to), place, e, from < to};
        }
    }
    auto begin = edges.begin();
    for (std::size_t vertex = 0; vertex + 1 < ends.size(); ++vertex) {
        const auto end = edges.begin() + ends[vertex];  // counting moved each end to where the next vertex begins
        std::sort(begin, end, comes_before);
        while (begin != end) {
            const auto same_end =
                std::find_if(begin, end, [&](const Edge& edge) { return edge.higher_vertex != begin->higher_vertex; });
            auto up = begin;
            auto down = begin;
            for (;;) {
                up = std::find_if(up, same_end, [](const Edge& edge) { return edge.ascends; });
                down = std::find_if(down, same_end, [](const Edge& edge) { return !edge.ascends; });
                if (up == same_end || down == same_end) break;
                across_[up->place][up->number] = down->place;
                across_[down->place][down->number] = up->place;
                ++up;
                ++down;
            }
            begin = same_end;
        }
    }
}

}  // namespace espalier::baker
