// Distances to the baked surface, in lattice steps, for what was dropped from it.
#pragma once

#include <array>
#include <cstdint>

#include "binary_tree.hpp"
#include "lattice_mesh.hpp"

namespace espalier::baker {

/// A position in lattice steps, anywhere.
using StepPoint = std::array<double, 3>;

class KeptSurface {
public:
    /// The mesh keeps at least one triangle, and outlives this.
    explicit KeptSurface(const LatticeMesh& mesh);

    /// At least the largest distance that any point of the segment has from the surface, and little more, unless no more than
    /// `ignore_below`: then anything from that distance to `ignore_below`.
    [[nodiscard]] double farthest_of_segment(const StepPoint& a, const StepPoint& b, double ignore_below) const;

private:
    struct Nearest {
        double distance;
        std::uint32_t triangle;
    };
    [[nodiscard]] Nearest nearest(const StepPoint& point) const;
    [[nodiscard]] double distance_to_triangle(const StepPoint& point, std::uint32_t triangle) const;
    [[nodiscard]] double bound(const StepPoint& a, const Nearest& near_a, const StepPoint& b, const Nearest& near_b,
                               double ignore_below, unsigned halvings) const;

    const LatticeMesh& mesh_;
    BinaryTree tree_;
};

}  // namespace espalier::baker
