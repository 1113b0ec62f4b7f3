// The loop over all baked triangles: what every traversal must equal, bit for bit. It asks the runtime's kernels about
// each triangle that the independent decoder found and that is not clear of the query (triangle_bounds.hpp), in storage
// order, and knows no tree.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <espalier/blob.hpp>
#include <runtime/answers/found.hpp>
#include <runtime/overlap/rounded_shapes.hpp>
#include <runtime/proximity/queries.hpp>
#include <runtime/proximity/winding.hpp>
#include <runtime/rays/whole_segment.hpp>
#include <runtime/sweeps/queries.hpp>

#include "support/format/decoder.hpp"
#include "triangle_bounds.hpp"

namespace espalier::tests {

class TriangleLoop {
public:
    explicit TriangleLoop(const DecodedBlob& decoded, LeftOut left_out = LeftOut::what_is_clear);

    /// In storage order.
    [[nodiscard]] std::vector<detail::FoundHit> every_hit(const detail::LatticeRay& ray) const;
    [[nodiscard]] bool is_crossing(const detail::LatticeRay& ray, const detail::FoundHit& found) const;

    /// Of no triangle where there is none.
    [[nodiscard]] LatticeHit first_hit(const detail::WholeSegment& segment) const;

    using Indices = std::vector<std::uint32_t>;
    [[nodiscard]] Indices every_overlap(const detail::RoundedPoint& point) const;
    // Of volumes that were rounded and are not empty.
    [[nodiscard]] Indices every_overlap(const detail::Rounded<Capsule>& capsule) const;
    [[nodiscard]] Indices every_overlap(const detail::Rounded<Box>& box) const;
    [[nodiscard]] Indices every_overlap(const detail::Rounded<OrientedBox>& box) const;
    [[nodiscard]] Indices every_overlap(const detail::Rounded<Triangle>& corners) const;
    [[nodiscard]] Indices every_overlap(const detail::Rounded<ConvexVolume>& set) const;

    /// The first `count` of those within the radius, sorted by distance and index.
    [[nodiscard]] std::vector<detail::FoundNearest> by_distance(const detail::RoundedPoint& point,
                                                                std::size_t count = TriangleBounds::all) const;
    /// The first of them.
    [[nodiscard]] std::optional<detail::FoundNearest> closest_within(const detail::RoundedPoint& point) const;
    [[nodiscard]] std::optional<detail::FoundPair> closest_pair(const detail::DistantSegment& segment) const;
    [[nodiscard]] std::optional<detail::FoundPair> closest_pair(const detail::DistantBox& box) const;
    /// Along the ray's direction.
    [[nodiscard]] detail::Winding winding(const detail::WindingRay& ray) const;

    /// The first of those that the filter leaves, and the options.
    using Filter = bool (*)(TriangleId);
    [[nodiscard]] detail::FoundContact first_contact(const detail::CapsuleSweep& sweep, Filter filter,
                                                     const SweepOptions& options = {}) const;
    [[nodiscard]] detail::FoundContact first_contact(const detail::BoxSweep& sweep, Filter filter,
                                                     const SweepOptions& options = {}) const;
    [[nodiscard]] detail::FoundContact first_contact(const detail::HullSweep& sweep, Filter filter,
                                                     const SweepOptions& options = {}) const;

private:
    [[nodiscard]] Indices every_overlap(const detail::Volume& volume, const TriangleBounds::Numbers& numbers) const;
    [[nodiscard]] std::optional<detail::FoundPair> closest_pair(const detail::DistantShape& shape,
                                                                const TriangleBounds::Numbers& numbers) const;
    template <class Sweep>
    [[nodiscard]] detail::FoundContact first_contact_of(const Sweep& sweep, const detail::Integer3& low,
                                                        const detail::Integer3& high, Filter filter,
                                                        const SweepOptions& options) const;

    // Copies are no triangles of their own: without them.
    std::vector<detail::LatticeTriangle> triangles_;
    std::vector<std::uint32_t> indices_;
    TriangleBounds bounds_;
};

// What a shape that moves is rounded to.
inline detail::CapsuleSweep sweep_of(const Sphere&) { return {}; }
inline detail::CapsuleSweep sweep_of(const Capsule&) { return {}; }
inline detail::BoxSweep sweep_of(const Box&) { return {}; }
inline detail::HullSweep sweep_of(const OrientedBox&) { return {}; }
inline detail::HullSweep sweep_of(const ConvexHull&) { return {}; }

}  // namespace espalier::tests
