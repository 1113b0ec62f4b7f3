#include "structures.hpp"

namespace espalier::bench {

UniformGrid::UniformGrid(std::span<const FloatTriangle> triangles, double density, float margin,
                         const FloatTest* float_test)
    : CellStructure("grid", triangles, margin, float_test) {
    std::array<double, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) side[k] = static_cast<double>(box_.high[k]) - static_cast<double>(box_.low[k]);
    // A flat box has no volume: no side counts as less than a hundredth of the longest.
    const double longest = *std::max_element(side.begin(), side.end());
    double volume = 1.0;
    for (const double s : side) volume *= std::max(s, 0.01 * longest);
    const double per_unit = std::cbrt(density * static_cast<double>(triangles.size()) / volume);
    for (std::size_t k = 0; k < 3; ++k) {
        count_[k] = std::max(1, static_cast<int>(std::lround(side[k] * per_unit)));
        size_[k] = static_cast<float>(side[k] / count_[k]);
    }
    const std::size_t cells_made = number_of(count_[0] - 1, count_[1] - 1, count_[2] - 1) + 1;
    first_.assign(cells_made + 1, 0);
    for (const FloatTriangle& triangle : triangles_)
        for_each_cell(triangle, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t cell = 0; cell < cells_made; ++cell) first_[cell + 1] += first_[cell];
    references_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        for_each_cell(triangles_[i], [&](std::size_t cell) { references_[next[cell]++] = i; });
    finish(cells_made, first_.size() * sizeof(std::uint32_t));
}

int UniformGrid::cell_of(float coordinate, std::size_t axis) const {
    return std::clamp(static_cast<int>((coordinate - box_.low[axis]) / size_[axis]), 0, count_[axis] - 1);
}

Aabb UniformGrid::box_of_cell(int x, int y, int z) const {
    const int at[3] = {x, y, z};
    Aabb box = Aabb::none();
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = box_.low[k] + static_cast<float>(at[k]) * size_[k];
        box.high[k] = box_.low[k] + static_cast<float>(at[k] + 1) * size_[k];
    }
    return box;
}

template <class Function>
void UniformGrid::for_each_cell(const FloatTriangle& triangle, Function function) const {
    const Aabb box = grown(box_of(triangle), margin_);
    const Corners3 corners = corners_of(triangle);
    std::array<int, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) low[k] = cell_of(box.low[k], k), high[k] = cell_of(box.high[k], k);
    const bool is_one_cell = low == high;
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x)
                if (is_one_cell || TriangleBoxTest(grown(box_of_cell(x, y, z), margin_)).touches(corners))
                    function(number_of(x, y, z));
}

double UniformGrid::closest(const Ray& ray, RayWork& work) {
    const FloatRay from(ray);
    double nearest = std::numeric_limits<double>::infinity();
    float enter = 0.0f, leave = 0.0f;
    if (!from.meets_box(box_, enter, leave)) return nearest;
    mailboxes_.begin_query();
    std::array<int, 3> at{}, step{}, end{};
    std::array<float, 3> next{};
    // Each border is computed from the number of the cell, so that no roundings add up.
    const auto border = [&](std::size_t k) {
        const float plane = box_.low[k] + static_cast<float>(at[k] + (step[k] > 0 ? 1 : 0)) * size_[k];
        return (plane - from.origin[k]) * from.inverse[k];
    };
    for (std::size_t k = 0; k < 3; ++k) {
        at[k] = cell_of(from.origin[k] + enter * from.direction[k], k);
        const bool is_forward = from.inverse[k] > 0.0f;
        step[k] = is_forward ? 1 : -1;
        end[k] = is_forward ? count_[k] : -1;
        next[k] = border(k);
    }
    for (;;) {
        ++work.box_tests;
        for (const std::uint32_t i : triangles_of(number_of(at[0], at[1], at[2]))) {
            if (!mailboxes_.take(i)) continue;
            ++work.triangle_tests;
            nearest = std::min(nearest, from.hit(triangles_[i], i, float_test_));
        }
        const std::size_t axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
        // A hit in this cell is the nearest. One behind it is in a triangle that reaches into this cell.
        if (nearest <= static_cast<double>(next[axis])) return nearest;
        at[axis] += step[axis];
        if (at[axis] == end[axis]) return nearest;
        next[axis] = border(axis);
    }
}

std::size_t UniformGrid::count_touching(const Aabb& box, RayWork& work) {
    std::array<int, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (box.high[k] < box_.low[k] || box.low[k] > box_.high[k]) return 0;
        low[k] = cell_of(box.low[k], k), high[k] = cell_of(box.high[k], k);
    }
    const TriangleBoxTest test(box);
    std::size_t touching = 0;
    mailboxes_.begin_query();
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x) {
                ++work.box_tests;
                for (const std::uint32_t i : triangles_of(number_of(x, y, z))) {
                    if (!mailboxes_.take(i)) continue;
                    ++work.triangle_tests;
                    touching += test.touches(corners_of(triangles_[i])) ? 1u : 0u;
                }
            }
    return touching;
}

}  // namespace espalier::bench
