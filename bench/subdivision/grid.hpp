// A uniform grid: equal cells, each with the triangles that touch it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cells.hpp"

namespace espalier::bench {

/// Rays walk from cell to cell by "A fast voxel traversal algorithm for ray tracing" (Amanatides, Woo 1987).
class UniformGrid {
public:
    /// Makes about `density` cells for each triangle (Cleary, Wyvill 1988), as cubes as the box allows. `margin`: of
    /// cells, when triangles are put into them. The triangles outlive the grid. Rays test triangles in double, or by
    /// `float_test`.
    UniformGrid(std::span<const FloatTriangle> triangles, double density, float margin,
                const FloatTest* float_test = nullptr);

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] double closest(const Ray& ray, CellWork& work);
    /// Counts the triangles that touch the box.
    [[nodiscard]] std::size_t count_touching(const Aabb& box, CellWork& work);

    [[nodiscard]] std::size_t cells() const { return first_.size() - 1; }
    [[nodiscard]] std::size_t references() const { return references_.size(); }
    /// Returns the bytes beside the triangles.
    [[nodiscard]] std::size_t bytes() const {
        return (first_.size() + references_.size()) * sizeof(std::uint32_t) + mailboxes_.bytes();
    }

private:
    [[nodiscard]] int cell_of(float coordinate, std::size_t axis) const;
    [[nodiscard]] Aabb box_of_cell(int x, int y, int z) const;
    [[nodiscard]] std::size_t number_of(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(count_[0]) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t cell) const {
        return std::span(references_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
    }
    /// Calls `function(cell)` for each cell that the triangle touches.
    template <class Function>
    void for_each_cell(const FloatTriangle& triangle, Function function) const;

    std::span<const FloatTriangle> triangles_;
    float margin_;
    const FloatTest* float_test_;
    Aabb box_;
    std::array<int, 3> count_{};
    std::array<float, 3> size_{};
    std::vector<std::uint32_t> first_;  ///< of each cell, in `references_`; one more at the end
    std::vector<std::uint32_t> references_;
    Mailboxes mailboxes_;
};

}  // namespace espalier::bench
