#include "baking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <import/base/numbers.hpp>
#include <import/base/placement.hpp>

#include "variants.hpp"

namespace espalier::tools {

namespace {

using Point = std::array<double, 3>;

/// Edges of two places are one if their middles are in one cell of a grid: of this share of the scene.
constexpr double cell_share = 0x1p-20;

/// Returns the middles of the edges with one triangle that lie in a side of the mesh's box.
std::vector<Point> border_of(const ImportedMesh& mesh) {
    const auto coordinates = [](const Vec3d& p) { return Point{p.x + 0.0, p.y + 0.0, p.z + 0.0}; };
    std::vector<std::pair<Point, Point>> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const TriangleVertices& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
            if (from >= mesh.positions.size() || to >= mesh.positions.size()) continue;
            if (!is_finite(mesh.positions[from]) || !is_finite(mesh.positions[to])) continue;
            const Point a = coordinates(mesh.positions[from]), b = coordinates(mesh.positions[to]);
            edges.emplace_back(std::minmax(a, b));
        }
    std::sort(edges.begin(), edges.end());
    const PointBox box = box_at(mesh, {});
    std::vector<Point> middles;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        const auto& [a, b] = edges[i];
        const bool is_single = end == i + 1;
        i = end;
        if (!is_single) continue;
        Point middle{};
        bool is_on_side = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const double from = a[k], to = b[k];
            is_on_side |= from == to && (from == box.low[k] || from == box.high[k]);
            middle[k] = (from + to) / 2;
        }
        if (is_on_side) middles.push_back(middle);
    }
    return middles;
}

/// A border edge of a place.
struct BorderEdge {
    std::array<std::int64_t, 3> cell;
    std::uint32_t place;

    friend auto operator<=>(const BorderEdge&, const BorderEdge&) = default;
};

Point at(const Placement& placement, const Point& p) {
    Point placed = placement.offset;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) placed[i] += placement.linear[i][k] * p[k];
    return placed;
}

/// For each place whether it is merged with others, and whether it is on the common lattice.
struct PlaceState {
    bool is_merged = true;
    bool is_on_lattice = false;
};

std::vector<PlaceState> states_of(std::size_t places, const SceneBake& baked, const BakedScene& scene) {
    std::vector<PlaceState> states(places);
    bool is_merged_on_lattice = false;
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const bool is_on_lattice = is_on_common_lattice(scene, {i}).yes();
        if (const std::optional<std::uint32_t> place = baked.places[instance_at(scene, {i})->source])
            states[*place] = {false, is_on_lattice};
        else is_merged_on_lattice = is_on_lattice;
    }
    for (PlaceState& state : states)
        if (state.is_merged) state.is_on_lattice = is_merged_on_lattice;
    return states;
}

/// Returns how many places of an import share an edge of their borders with another place, from which the bake may have
/// moved them: the two are neither in one blob nor both on the scene's common lattice. A border edge is one of a single
/// triangle, on a side of the mesh's box.
std::uint64_t places_apart(const ImportResult& imported, const SceneBake& baked, const BakedScene& scene) {
    if (scene.instance_count() < 2) return 0;
    const std::vector<PlaceState> states = states_of(imported.places.size(), baked, scene);
    const Box bounds = scene.bounds();
    const double extent =
        std::max({double(bounds.max.x) - double(bounds.min.x), double(bounds.max.y) - double(bounds.min.y),
                  double(bounds.max.z) - double(bounds.min.z)});
    std::map<std::uint32_t, std::vector<Point>> border_of_mesh;
    std::vector<BorderEdge> edges;
    for (std::uint32_t i = 0; i < imported.places.size(); ++i) {
        const ImportedPlace& place = imported.places[i];
        const auto [border, is_new] = border_of_mesh.try_emplace(place.mesh);
        if (is_new) border->second = border_of(imported.meshes[place.mesh]);
        for (const Point& middle : border->second) {
            const Point placed = at(place.placement, middle);
            BorderEdge& edge = edges.emplace_back(BorderEdge{{}, i});
            for (std::size_t k = 0; k < 3; ++k) {
                const double cells = std::floor(placed[k] / (extent * cell_share));
                edge.cell[k] = std::abs(cells) < 0x1p62 ? static_cast<std::int64_t>(cells) : 0;
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<bool> is_apart(imported.places.size());
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        bool all_merged = true, all_on_lattice = true;
        for (; end < edges.size() && edges[end].cell == edges[i].cell; ++end) {
            all_merged &= states[edges[end].place].is_merged;
            all_on_lattice &= states[edges[end].place].is_on_lattice;
        }
        if (!all_merged && !all_on_lattice && edges[i].place != edges[end - 1].place)
            for (std::size_t k = i; k < end; ++k) is_apart[edges[k].place] = true;
        i = end;
    }
    return static_cast<std::uint64_t>(std::count(is_apart.begin(), is_apart.end(), true));
}

}  // namespace

std::vector<Warning> border_warnings(const ImportResult& imported, const SceneBake& baked, const BakedScene& scene) {
    const std::uint64_t count = places_apart(imported, baked, scene);
    if (count == 0) return {};
    return {
        {"borders_apart",
         text(counted(count, "mesh place"), count == 1 ? " shares" : " share",
              " border edges with others, and instances are rounded apart from each other: a ray can pass through "
              "gaps of up to ",
              rounded(2.0 * baked.max_error), ". Give a --step that divides all their positions, or --instances off."),
         {},
         {},
         {}}};
}

}  // namespace espalier::tools
