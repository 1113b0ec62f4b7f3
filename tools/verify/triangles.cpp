#include "triangles.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <baker/input/zero_area.hpp>
#include <import/base/numbers.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

/// A triangle takes some microseconds in a scene, where a forest may have billions of them.
constexpr std::uint64_t most_triangles_checked = 10'000'000;

bool has_no_area(const SourceCorners& corners) { return baker::has_zero_area(corners[0], corners[1], corners[2]); }

/// What became of a triangle of the source.
struct Fate {
    Match match = Match::none;
    Finding Findings::*dropped_for = nullptr;  ///< why it is not there, if a bake drops such triangles
};

Fate fate_of(const ImportedMesh& mesh, std::uint64_t triangle, const ImportedPlace& place, StoredTriangles& stored) {
    const std::optional<SourceCorners> corners = corners_of(mesh, triangle);
    if (!corners) {
        const TriangleVertices& vertices = mesh.triangles[triangle];
        const bool are_there = std::all_of(vertices.begin(), vertices.end(),
                                           [&](std::uint32_t vertex) { return vertex < mesh.positions.size(); });
        return {Match::none, are_there ? &Findings::not_finite : &Findings::index_out_of_range};
    }
    const SourceCorners placed = corners_at(place, *corners);
    const Match match = stored.match(placed);
    if (match == Match::first) return {match};
    if (match == Match::again) return {match, &Findings::duplicate};
    if (has_no_area(*corners) || has_no_area(placed)) return {match, &Findings::zero_area};
    return {match, stored.may_collapse(placed) ? &Findings::collapsed : nullptr};
}

}  // namespace

TriangleCheck check_triangles(StoredTriangles& stored, const ImportResult& source) {
    TriangleCheck check;
    check.stored = stored.size();
    const std::vector<ImportedPlace> places = places_of(source);
    for (const ImportedPlace& place : places) check.triangles += source.meshes[place.mesh].triangles.size();
    const std::uint64_t stride =
        std::max<std::uint64_t>(1, (check.triangles + most_triangles_checked - 1) / most_triangles_checked);
    std::uint64_t next = 0;  // of the place's triangles
    for (const ImportedPlace& place : places) {
        const ImportedMesh& mesh = source.meshes[place.mesh];
        for (; next < mesh.triangles.size(); next += stride) {
            ++check.checked;
            const auto [match, dropped_for] = fate_of(mesh, next, place, stored);
            if (dropped_for != nullptr) ++(check.dropped.*dropped_for).count;
            if (match != Match::none || dropped_for != nullptr || check.missing++ != 0) continue;
            check.first_missing = text(name_of_place(source, place), ", triangle ", next);
            check.first_missing_at = SourcePlace{place.file, place.number, static_cast<std::uint32_t>(next)};
        }
        next -= mesh.triangles.size();
    }
    if (stride == 1) check.sourceless = stored.sourceless();
    return check;
}

}  // namespace espalier::tools
