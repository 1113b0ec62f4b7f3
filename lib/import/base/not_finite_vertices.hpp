// Vertices with a coordinate that is NaN or infinite, and where their file has them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <import/base/error.hpp>
#include <import/base/importers.hpp>
#include <import/base/missing_vertices.hpp>

namespace espalier::importer {

/// Returns "x = NaN" for the first such coordinate; nothing without one.
inline std::optional<std::string> words_for_not_finite(const Vec3d& position) {
    const std::array<double, 3> coordinates{position.x, position.y, position.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = coordinates[axis];
        if (std::isfinite(value)) continue;
        return text("xyz"[axis], " = ", std::isnan(value) ? "NaN" : value > 0.0 ? "infinity" : "-infinity");
    }
    return std::nullopt;
}

/// Ends an import for a triangle of a mesh with such a corner. `place` is "line 12: vertex 3, counted from 1,".
[[noreturn]] inline void refuse_not_finite(const std::string& path, const ImportOptions& options,
                                           const std::string& place, const std::string& words, std::uint32_t mesh,
                                           std::uint64_t triangle) {
    throw ImportError(ImportStatus::invalid_input,
                      text('\'', printable(path), "', ", place, " has ", words, ", and triangle ", triangle,
                           " of mesh ", mesh, " needs it. ", way_out_of_bad_triangle(options)),
                      {.file = path, .mesh = mesh, .triangle = triangle});
}

/// A vertex that no face needs may have any coordinates.
class NotFiniteVertices {
public:
    /// Called with all vertices in their order. `describe` returns the place of the vertex.
    template <class Describe>
    void look_at(std::uint64_t vertex, const Vec3d& position, const Describe& describe) {
        if (auto words = words_for_not_finite(position)) found_.push_back({vertex, describe(), std::move(*words)});
    }
    /// Throws ImportError (invalid_input) for a face with such a corner, when the options require its vertices.
    void check(std::span<const std::uint32_t> corners, const ImportedFile& file, const ImportOptions& options,
               std::uint32_t mesh, std::uint64_t triangle) const {
        if (found_.empty() || !options.require_vertices) return;
        for (const std::uint32_t corner : corners) {
            const auto vertex =
                std::lower_bound(found_.begin(), found_.end(), corner,
                                 [](const Found& found, std::uint32_t number) { return found.vertex < number; });
            if (vertex == found_.end() || vertex->vertex != corner) continue;
            refuse_not_finite(file.path, options, vertex->place, vertex->words, mesh, triangle);
        }
    }

private:
    struct Found {
        std::uint64_t vertex;
        std::string place;
        std::string words;
    };
    std::vector<Found> found_;  // in the order of the vertices
};

}  // namespace espalier::importer
