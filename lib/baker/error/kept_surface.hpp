// Distances to the baked surface, in lattice steps, for what was dropped from it.
#pragma once

#include <array>
#include <cstdint>

#include <baker/build/binary_tree.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// A position in lattice steps, anywhere.
using StepPoint = std::array<double, 3>;

class KeptSurface {
public:
    /// The mesh keeps at least one triangle, and outlives this.
    explicit KeptSurface(const LatticeMesh& mesh);

    /// At least the largest distance that any point of the segment has from the surface, and little more; or anything
    /// up to `ignore_below`, or to a thousandth of a step, when it is less than that.
    [[nodiscard]] double farthest_of_segment(const StepPoint& a, const StepPoint& b, double ignore_below);

private:
    /// A triangle and its distance: the nearest one, or any that is near enough, or the best of many.
    struct Nearest {
        double distance;
        std::uint32_t triangle;
    };
    [[nodiscard]] Nearest nearest(const StepPoint& point, double enough);
    [[nodiscard]] double distance_to_triangle(const StepPoint& point, std::uint32_t triangle) const;
    [[nodiscard]] double bound(const StepPoint& a, const Nearest& near_a, const StepPoint& b, const Nearest& near_b,
                               double ignore_below, unsigned& pieces);

    const LatticeMesh& mesh_;
    BinaryTree tree_;
    std::uint64_t distances_left_;
};

}  // namespace espalier::baker
