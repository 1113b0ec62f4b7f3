// Polygons in a plane to triangles, by cutting off one corner after the other.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/bake.hpp>

#include <import/base/corner_set.hpp>
#include <import/base/corner_tree.hpp>

namespace espalier::importer {

/// How a polygon was cut. `too_tangled`: not at all, as it would have taken too long.
enum class PolygonCut : std::uint8_t { simple, crossing, too_tangled };

/// Cuts the polygons of one file; keeps its memory from one to the next.
class EarCutter {
public:
    /// Appends the triangles of a polygon that runs counter-clockwise. Where it crosses itself, a fan of triangles
    /// ends them. Most outlines take n log n steps; one that takes more than 1000 for each corner, and more than are
    /// spare for the file, is `too_tangled`.
    PolygonCut cut(const std::vector<PlanePoint>& points, std::vector<TriangleVertices>& triangles);

private:
    /// A corner that was no ear since another one lies in its triangle, and the next one that it blocks.
    struct Blocked {
        std::uint32_t corner;
        std::uint32_t next;
    };

    [[nodiscard]] bool is_too_tangled() const;
    PolygonCut cut_all(std::uint32_t corners, std::vector<TriangleVertices>& triangles);
    void update_turn(std::uint32_t corner);
    void update_ear(std::uint32_t corner) { ears_.set(corner, is_ear(corner)); }
    [[nodiscard]] bool is_ear(std::uint32_t corner);
    void unblock(std::uint32_t blocker);
    void cut_off(std::uint32_t tip, std::vector<TriangleVertices>& triangles);
    [[nodiscard]] bool find_tip(std::uint32_t& corner);

    const std::vector<PlanePoint>* points_ = nullptr;
    std::vector<std::uint32_t> before_;
    std::vector<std::uint32_t> after_;
    std::vector<double> turns_;
    CornerTree reflex_;   // of those that are left, the corners that do not turn to the left
    CornerSet ears_;      // as they were when their neighbours changed last
    CornerSet straight_;  // with a turn of 0
    CornerSet unblocked_;
    std::vector<std::uint32_t> blockers_;       // of each corner that was no ear, a corner in its triangle
    std::vector<std::uint32_t> first_blocked_;  // of each corner, in blocked_
    std::vector<Blocked> blocked_;
    std::uint64_t steps_ = 0;
    std::uint64_t spare_steps_ = std::uint64_t{1} << 26;  // so that outlines of some thousand corners take any number
};

}  // namespace espalier::importer
