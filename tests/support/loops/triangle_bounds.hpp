// What is known of triangles before a kernel is asked: the box around each, and the box around every 32 neighbours in
// storage order, in double. The loops over all triangles leave out those that are so clear of a query, by more than a
// lattice step, which no rounding of a double or of a kernel's answer makes up for. No tree, and nothing that the
// runtime culls with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <runtime/lattice/triangle.hpp>
#include <runtime/traversal/box_nodes.hpp>

namespace espalier::tests {

/// What a loop leaves out without asking: to see that it does not matter, a loop can be made to ask of everything.
enum class LeftOut { what_is_clear, nothing };

/// In lattice steps.
struct Place {
    double x, y, z;
};

/// A box, by its lowest and highest corner.
struct Range {
    Place low, high;
};

class TriangleBounds {
public:
    TriangleBounds(const std::vector<detail::LatticeTriangle>& triangles, LeftOut left_out);

    // Each of these answers with the numbers of all triangles that are not clear of the query, in ascending order.

    using Numbers = std::vector<std::uint32_t>;
    [[nodiscard]] Numbers near(const Range& box) const;
    /// That reach into all of the half-spaces.
    [[nodiscard]] Numbers behind(std::span<const detail::LatticePlane> planes) const;

    struct Met {
        double when;  ///< not before
        std::uint32_t number;
    };
    /// That a box meets while it moves from `first` to `last` times the way, at 1 by all of it; a ray is a box too.
    [[nodiscard]] std::vector<Met> on_the_way(const Range& start, const Place& way, double first, double last) const;

    static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
    /// That may be among the `count` closest, and within the radius.
    [[nodiscard]] Numbers closest_to_segment(const Place& from, const Place& to, double radius,
                                             std::size_t count = all) const;
    [[nodiscard]] Numbers closest_to_box(const Range& box, double radius, std::size_t count = all) const;

private:
    struct Bounds {
        double low[3], high[3];
        double center[3];
        double radius;  // of the ball around the center that holds the box

        void extend(const double* place);
        void finish();
    };
    static constexpr std::size_t group_size = 32;

    template <class MayMatter>
    [[nodiscard]] Numbers numbers_where(MayMatter may_matter) const;
    template <class DistanceOf>
    [[nodiscard]] Numbers closest(DistanceOf distance_of, double radius, std::size_t count) const;
    template <class DistanceOf>
    [[nodiscard]] double reach_of_closest(DistanceOf distance_of, std::size_t count) const;

    LeftOut left_out_;
    std::vector<Bounds> triangles_;
    std::vector<Bounds> groups_;
};

}  // namespace espalier::tests
