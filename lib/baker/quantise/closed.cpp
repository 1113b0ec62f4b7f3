#include <baker/quantise/closed.hpp>

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include <baker/base/edge_table.hpp>
#include <baker/base/indexed_hash_set.hpp>

namespace espalier::baker {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// An edge that runs `count` times more often from `from` to `to` than back; below zero it is the other way round.
struct UnpairedEdge {
    std::uint32_t from;
    std::uint32_t to;
    std::int64_t count;
};

/// Cancels edges in pairs of opposite direction and returns what is left.
template <class Triangles>
std::vector<UnpairedEdge> unpaired_edges(const Triangles& triangles, std::size_t vertex_count) {
    const auto corners_of = [&](std::uint32_t triangle) -> const Corners& { return triangles[triangle].corners; };
    std::vector<UnpairedEdge> unpaired;
    const EdgeTable table(static_cast<std::uint32_t>(triangles.size()), vertex_count, corners_of);
    table.for_each_pair([&](std::uint32_t low, std::span<const TriangleEdge> edges) {
        const std::uint32_t high = edges.front().higher_vertex;
        std::int64_t count = 0;
        for (const TriangleEdge& edge : edges) count += edge.ascends ? 1 : -1;
        if (count != 0 && high != low) unpaired.push_back({low, high, count});
    });
    return unpaired;
}

/// Twice the areas' vectors add up to zero over a closed surface, of whatever triangles it is made. A sum that is not
/// zero is the cheap answer for almost every open mesh. It wraps around: zero stays zero.
bool areas_cancel(const LatticeMesh& mesh) {
    std::array<std::uint64_t, 3> sum{};
    for (const LatticeTriangle& triangle : mesh.triangles) {
        const LatticePoint& a = mesh.vertices[triangle.corners[0]];
        const LatticePoint& b = mesh.vertices[triangle.corners[1]];
        const LatticePoint& c = mesh.vertices[triangle.corners[2]];
        const std::array<std::int64_t, 3> ab{b.x - a.x, b.y - a.y, b.z - a.z};
        const std::array<std::int64_t, 3> ac{c.x - a.x, c.y - a.y, c.z - a.z};
        // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
        // mutant(< -> >=) work: every mesh goes through the exact test
        for (std::size_t k = 0; k < 3; ++k) {
            // mutant(+ -> - 1, + -> right side dropped 1) work: fewer coordinates of the sum are computed
            // mutant(+ -> - 2, + -> right side dropped 2) work: fewer coordinates of the sum are computed
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            // mutant(+= nothing) work: every mesh goes through the exact test
            sum[k] += static_cast<std::uint64_t>(ab[i] * ac[j] - ab[j] * ac[i]);
        }
    }
    // mutant(== -> true) work: every mesh goes through the exact test
    return sum == std::array<std::uint64_t, 3>{};
}

/// An end of an edge, and the line that the edge lies on.
struct EdgeEnd {
    std::uint32_t vertex;
    LatticePoint direction;  ///< of the line: without common factor, the first coordinate that is not zero above zero
    std::int64_t count;      ///< of edges that begin here, less those that end here

    [[nodiscard]] auto place() const { return std::tuple(vertex, direction.x, direction.y, direction.z); }
};

LatticePoint line_direction(const LatticePoint& from, const LatticePoint& to) {
    const LatticePoint along = {to.x - from.x, to.y - from.y, to.z - from.z};
    const std::int32_t first = along.x != 0 ? along.x : along.y != 0 ? along.y : along.z;
    // mutant(< -> <=) equivalent: an edge has a length, so that its first coordinate is not 0
    // mutant(< -> >=) equivalent: every line gets the opposite direction
    const std::int32_t divisor = std::gcd(std::gcd(along.x, along.y), along.z) * (first < 0 ? -1 : 1);
    return {along.x / divisor, along.y / divisor, along.z / divisor};
}

/// Along a line the number of edges that run one way, less those that run the other way, changes only at vertices. It
/// is zero everywhere on the line when it changes nowhere: when at each vertex as many edges of the line begin as end.
bool cancel_along_lines(const std::vector<UnpairedEdge>& edges, const std::vector<LatticePoint>& vertices) {
    std::vector<EdgeEnd> ends;
    ends.reserve(2 * edges.size());
    for (const auto& [from, to, count] : edges) {
        const LatticePoint direction = line_direction(vertices[from], vertices[to]);
        ends.push_back({from, direction, count});
        ends.push_back({to, direction, -count});
    }
    std::ranges::sort(ends, {}, &EdgeEnd::place);
    for (std::size_t i = 0; i < ends.size();) {
        std::int64_t sum = 0;
        const auto place = ends[i].place();
        // mutant(< -> <=, without 1) sanitizer: reads behind the last end
        for (; i < ends.size() && ends[i].place() == place; ++i) sum += ends[i].count;
        if (sum != 0) return false;
    }
    return true;
}

/// Triangles over positions of which no two are equal.
struct WeldedSource {
    struct Triangle {
        Corners corners;
    };
    std::vector<Triangle> triangles;
    std::size_t vertex_count = 0;
};

WeldedSource weld(const Source& source) {
    const auto bits = [](double coordinate) { return std::bit_cast<std::uint64_t>(coordinate + 0.0); };  // -0 is 0
    WeldedSource welded;
    welded.vertex_count = source.positions.size();
    IndexedHashSet table(source.positions.size());
    const auto vertex_of = [&](std::uint32_t position) {
        const Vec3d& point = source.positions[position];
        const std::uint64_t hash = mix_bits(bits(point.x) ^ mix_bits(bits(point.y) ^ mix_bits(bits(point.z))));
        return table.find_or_insert(hash, position,
                                    [&](std::uint32_t other) { return source.positions[other] == point; });
    };
    for (const auto* triangles : {&source.triangles, &source.without_area}) {
        for (const SourceTriangle& triangle : *triangles) {
            const auto [a, b, c] = triangle.corners;
            welded.triangles.push_back({{vertex_of(a), vertex_of(b), vertex_of(c)}});
        }
    }
    return welded;
}

}  // namespace

bool is_closed(const LatticeMesh& mesh) {
    // mutant(without 2, without 3) work: every mesh goes through the exact test
    return !mesh.triangles.empty() && areas_cancel(mesh) &&
           cancel_along_lines(unpaired_edges(mesh.triangles, mesh.vertices.size()), mesh.vertices);
}

bool edges_cancel_in_pairs(const LatticeMesh& mesh) {
    return !mesh.triangles.empty() && unpaired_edges(mesh.triangles, mesh.vertices.size()).empty();
}

bool is_closed(const Source& source) {
    const WeldedSource welded = weld(source);
    return !welded.triangles.empty() && unpaired_edges(welded.triangles, welded.vertex_count).empty();
}

}  // namespace espalier::baker
