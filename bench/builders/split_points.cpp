#include <baker/build/sah_split.hpp>

#include "builders.hpp"

namespace espalier::bench {
namespace {

using namespace baker;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns a reference to each triangle, in the order of the mesh.
std::vector<Reference> references_of(const LatticeMesh& mesh) {
    std::vector<Reference> references(mesh.triangles.size());
    for (std::uint32_t i = 0; i < references.size(); ++i) put_reference(mesh, i, references[i]);
    return references;
}

void write_node(BinaryNode& node, const LaneBox& box, std::uint32_t first, std::uint32_t count) {
    std::memcpy(&node, &box, sizeof node);
    node.first = first;
    node.count = count;
}

/// Returns the axis along which the box is longest, of equal ones the first.
unsigned longest_side(const LaneBox& box) {
    const Lanes side = box.hi - box.lo;
    return side[0] >= side[1] && side[0] >= side[2] ? 0 : side[1] >= side[2] ? 1 : 2;
}

/// The box around some references, and the box around twice their centres.
struct Bounds {
    LaneBox box;
    LaneBox centers;

    explicit Bounds(std::span<const Reference> references) {
        for (const Reference& reference : references) {
            const LaneBox one = lane_box_of(reference);
            box.add(one);
            centers.add(one.lo + one.hi);
        }
    }
};

double mean_center(std::span<const Reference> references, unsigned axis) {
    double sum = 0.0;  // of whole numbers: exact
    for (const Reference& reference : references) sum += double(center_of(reference, axis));
    return sum / static_cast<double>(references.size());
}

unsigned axis_of_greatest_variance(std::span<const Reference> references) {
    std::array<double, 3> sums{};
    for (unsigned axis = 0; axis < 3; ++axis) {
        const double mean = mean_center(references, axis);
        for (const Reference& reference : references) {
            const double away = double(center_of(reference, axis)) - mean;
            sums[axis] += away * away;
        }
    }
    return static_cast<unsigned>(std::max_element(sums.begin(), sums.end()) - sums.begin());
}

class PointBuilder {
public:
    PointBuilder(std::span<Reference> references, SplitAxis axis, SplitPoint point, const BuildSettings& settings,
                 BinaryNode* nodes)
        : references_(references), axis_(axis), point_(point), settings_(settings), nodes_(nodes) {}

    void build(std::uint32_t first, std::uint32_t count, std::size_t node, unsigned depth) {
        const auto references = references_.subspan(first, count);
        const Bounds bounds(references);
        write_node(nodes_[node], bounds.box, first, count);
        if (count == 1) return;
        const bool must_balance = !leaves_room(depth, count - 1, settings_.most_height);
        const std::uint32_t left_count =
            must_balance ? part_in_halves(references, longest_side(bounds.centers)) : part(references, bounds);
        build(first, left_count, node + 1, depth + 1);
        build(first + left_count, count - left_count, node + 1 + subtree_nodes(left_count), depth + 1);
    }

private:
    /// Reorders the references and returns how many of them go left.
    std::uint32_t part(std::span<Reference> references, const Bounds& bounds) const {
        const unsigned axis = choose_axis(references, bounds);
        if (point_ == SplitPoint::object_median) return part_in_halves(references, axis);
        const double place = place_on(axis, references, bounds);
        const auto middle = std::partition(references.begin(), references.end(), [&](const Reference& reference) {
            return double(center_of(reference, axis)) < place;
        });
        const bool one_is_empty = middle == references.begin() || middle == references.end();
        if (one_is_empty) return part_in_halves(references, axis);
        return static_cast<std::uint32_t>(middle - references.begin());
    }

    static std::uint32_t part_in_halves(std::span<Reference> references, unsigned axis) {
        const auto half = static_cast<std::uint32_t>(references.size() / 2);
        std::nth_element(references.begin(), references.begin() + half, references.end(), ByCenter{axis});
        return half;
    }

    [[nodiscard]] unsigned choose_axis(std::span<Reference> references, const Bounds& bounds) const {
        switch (axis_) {
            case SplitAxis::longest_side:
                break;
            case SplitAxis::greatest_variance:
                return axis_of_greatest_variance(references);
            case SplitAxis::least_sum:
            case SplitAxis::least_maximum:
                return axis_of_least_areas(references, bounds);
        }
        return longest_side(bounds.centers);
    }

    [[nodiscard]] unsigned axis_of_least_areas(std::span<Reference> references, const Bounds& bounds) const {
        double best = infinity;
        unsigned best_axis = longest_side(bounds.centers);
        for (unsigned axis = 0; axis < 3; ++axis) {
            const double areas = areas_of_split(axis, references, bounds);
            if (areas >= best) continue;
            best = areas;
            best_axis = axis;
        }
        return best_axis;
    }

    /// Returns the sum or the maximum of both sides' areas, infinity where one side is empty.
    [[nodiscard]] double areas_of_split(unsigned axis, std::span<Reference> references, const Bounds& bounds) const {
        std::array<LaneBox, 2> boxes;
        std::array<std::uint32_t, 2> counts{};
        const double place = place_on(axis, references, bounds);
        for (const Reference& reference : references) {
            const std::size_t side = double(center_of(reference, axis)) < place ? 0 : 1;
            boxes[side].add(lane_box_of(reference));
            ++counts[side];
        }
        if (counts[0] == 0 || counts[1] == 0) return infinity;
        const double left = double(boxes[0].half_area());
        const double right = double(boxes[1].half_area());
        return axis_ == SplitAxis::least_sum ? left + right : std::max(left, right);
    }

    /// Returns twice the split point. The references may be reordered.
    [[nodiscard]] double place_on(unsigned axis, std::span<Reference> references, const Bounds& bounds) const {
        switch (point_) {
            case SplitPoint::object_median:
                return double(center_of(references[part_in_halves(references, axis)], axis));
            case SplitPoint::object_mean:
                return mean_center(references, axis);
            case SplitPoint::spatial_median:
                break;
        }
        return (double(bounds.centers.lo[axis]) + double(bounds.centers.hi[axis])) / 2.0;
    }

    std::span<Reference> references_;
    SplitAxis axis_;
    SplitPoint point_;
    const BuildSettings& settings_;
    BinaryNode* nodes_;
};

}  // namespace

baker::BinaryTree build_at_points(const baker::LatticeMesh& mesh, SplitAxis axis, SplitPoint point,
                                  const baker::BuildSettings& settings) {
    BinaryTree tree;
    std::vector<Reference> references = references_of(mesh);
    const auto count = static_cast<std::uint32_t>(references.size());
    if (count == 0) return tree;
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    PointBuilder(references, axis, point, settings, tree.nodes.get()).build(0, count, 0, 0);
    for (const Reference& reference : references) tree.triangles.push_back(reference.triangle);
    return tree;
}

}  // namespace espalier::bench
