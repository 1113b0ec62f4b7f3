// What was found in the lines of a text, often or once: warnings name the first.
#pragma once

#include <cstdint>
#include <string>

#include <import/base/mesh_collector.hpp>
#include <import/base/numbers.hpp>

namespace espalier::importer {

inline constexpr const char* crossing_polygon_words =
    "the outline of a face crosses itself, and its triangles may cover more or less than meant. Triangulate it before "
    "export.";

inline constexpr const char* tangled_polygon_words =
    "the outline of a face has so many corners that lie between others that cutting it into triangles would take too "
    "long. Triangulate it before export.";

/// How often something was found, and the line of the first.
struct Occurrences {
    std::uint64_t count = 0;
    std::uint64_t first = 0;

    void add(std::uint64_t line) {
        if (count++ == 0) first = line;
    }
    /// Appends a warning that names the line, if anything was found.
    void warn(UnitlessFile& file, const char* kind, const std::string& message) const {
        if (count == 0) return;
        file.warn(kind, text(", line ", first, count == 1 ? "" : text(" and ", count - 1, " more"), ": ", message));
    }
};

}  // namespace espalier::importer
