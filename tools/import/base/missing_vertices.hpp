// Faces that name vertices which their file does not have.
#pragma once

#include <cstdint>
#include <string>

#include "base/numbers.hpp"
#include "mesh_collector.hpp"

namespace espalier::tools {

/// How many corners name such a vertex, and the first as the file writes it: a reader that counts from another number,
/// or backwards, has replaced it by then.
class MissingVertices {
public:
    /// `place` returns the face's, "line 12: face 3".
    template <class Place>
    void add(std::int64_t number, const Place& place) {
        if (count_++ > 0) return;
        number_ = number;
        place_ = place();
    }
    /// Appends a warning if there are any. The baker refuses or drops their triangles.
    void report(UnitlessFile& file, std::uint64_t vertices) const {
        if (count_ == 0) return;
        file.warn("missing_vertex",
                  text(", ", place_, " names vertex ", number_, ", and the file has ", counted(vertices, "vertex"),
                       " from 0", count_ == 1 ? "." : text("; so do ", count_ - 1, " more corners.")));
    }

private:
    std::uint64_t count_ = 0;
    std::int64_t number_ = 0;
    std::string place_;
};

}  // namespace espalier::tools
