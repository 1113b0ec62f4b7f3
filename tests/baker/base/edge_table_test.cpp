// The edges of triangles by the two vertices that they join.
#include "support/testing.hpp"

#include <baker/base/edge_table.hpp>

namespace espalier::baker {

namespace {

using Corners = std::array<std::uint32_t, 3>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

struct Edge {
    std::uint32_t triangle;
    unsigned number;
    bool ascends;
    bool operator==(const Edge&) const = default;
};

EdgeTable table_of(const std::vector<Corners>& triangles, std::size_t vertex_count) {
    return {static_cast<std::uint32_t>(triangles.size()), vertex_count,
            [&](std::uint32_t triangle) -> const Corners& { return triangles[triangle]; }};
}

/// Each pair with its edges, one triangle after the other.
std::map<Pair, std::vector<Edge>> edges_of(const std::vector<Corners>& triangles) {
    std::map<Pair, std::vector<Edge>> edges;
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
        const auto [a, b, c] = triangles[triangle];
        const Pair sides[3] = {{a, b}, {b, c}, {c, a}};
        for (unsigned number = 0; number < 3; ++number) {
            const auto [from, to] = sides[number];
            const bool ascends = to > from;
            edges[ascends ? Pair{from, to} : Pair{to, from}].push_back({triangle, number, ascends});
        }
    }
    return edges;
}

}  // namespace

TEST_CASE("edge table: every pair of vertices comes once with all edges that join it") {
    tests::Random random(27);
    for (int i = 0; i < 300; ++i) {
        // Few vertices: edges with many triangles, and triangles with one vertex twice or three times.
        const std::uint32_t vertex_count = 1 + random.below(i < 150 ? 6 : 60);
        std::vector<Corners> triangles(random.below(i < 150 ? 12 : 200));
        for (Corners& corners : triangles)
            for (std::uint32_t& corner : corners) corner = random.below(vertex_count);
        const EdgeTable table = table_of(triangles, vertex_count);
        const std::map<Pair, std::vector<Edge>> expected = edges_of(triangles);

        auto next = expected.begin();
        table.for_each_pair([&](std::uint32_t lower, std::span<const TriangleEdge> edges) {
            REQUIRE(next != expected.end());
            REQUIRE(!edges.empty());
            CHECK(Pair(lower, edges.front().higher_vertex) == next->first);
            std::vector<Edge> found;
            for (const TriangleEdge& edge : edges) {
                CHECK(edge.higher_vertex == edges.front().higher_vertex);
                found.push_back({edge.triangle, edge.number, edge.ascends});
            }
            CHECK(found == next->second);
            ++next;
        });
        CHECK(next == expected.end());

        for (std::uint32_t a = 0; a < vertex_count; ++a)
            for (std::uint32_t b = 0; b < vertex_count; ++b)
                CHECK(table.contains(a, b) == expected.contains(a < b ? Pair{a, b} : Pair{b, a}));
    }
}

TEST_CASE("edge table: one without triangles is empty") {
    const auto fail = [](std::uint32_t, std::span<const TriangleEdge>) { FAIL("there is no edge"); };
    EdgeTable().for_each_pair(fail);
    table_of({}, 5).for_each_pair(fail);
    CHECK(!table_of({}, 5).contains(2, 3));
}

}  // namespace espalier::baker
