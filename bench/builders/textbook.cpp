#include "textbook.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <baker/build/sah_split.hpp>

namespace espalier::bench {
namespace {

using namespace baker;

LaneBox box_around(std::span<const Reference> references) {
    LaneBox box;
    for (const Reference& reference : references) box.add(lane_box_of(reference));
    return box;
}

unsigned widest_axis(std::span<const Reference> references) {
    LaneBox centers;
    for (const Reference& reference : references) {
        const LaneBox box = lane_box_of(reference);
        centers.add(box.lo + box.hi);
    }
    const Lanes spread = centers.hi - centers.lo;
    return spread[0] >= spread[1] && spread[0] >= spread[2] ? 0 : spread[1] >= spread[2] ? 1 : 2;
}

/// What lies before the place along the axis, of references that are sorted along it.
std::uint32_t count_before(std::span<const Reference> references, unsigned axis, double place) {
    const auto end = std::partition_point(references.begin(), references.end(), [&](const Reference& reference) {
        return double(center_of(reference, axis)) < place;
    });
    return static_cast<std::uint32_t>(end - references.begin());
}

double mean_center(std::span<const Reference> references, unsigned axis) {
    double sum = 0.0;
    for (const Reference& reference : references) sum += double(center_of(reference, axis));
    return sum / static_cast<double>(references.size());
}

double overlap_area(const LaneBox& a, const LaneBox& b) {
    LaneBox both;
    both.lo = larger(a.lo, b.lo);
    both.hi = smaller(a.hi, b.hi);
    for (int axis = 0; axis < 3; ++axis) {
        if (both.lo[axis] > both.hi[axis]) return -1.0;  // apart is better than touching
    }
    return double(both.half_area());
}

double objective(Textbook rule, unsigned axis, const LaneBox& left, const LaneBox& right) {
    const double left_area = double(left.half_area());
    const double right_area = double(right.half_area());
    switch (rule) {
        case Textbook::minimum_sum:
            return left_area + right_area;
        case Textbook::minimum_maximum:
            return std::max(left_area, right_area);
        case Textbook::minimum_intersection:
            return overlap_area(left, right);
        case Textbook::maximum_separation:
            return double(left.hi[axis]) - double(right.lo[axis]);
        case Textbook::object_median:
        case Textbook::object_mean:
        case Textbook::spatial_median:
            break;
    }
    return 0.0;
}

class TextbookBuilder {
public:
    TextbookBuilder(std::span<Reference> references, Textbook rule, const BuildSettings& settings, BinaryNode* nodes)
        : references_(references), rule_(rule), settings_(settings), nodes_(nodes), right_boxes_(references.size()) {}

    void build(std::uint32_t first, std::uint32_t count, std::size_t node, unsigned depth) {
        const auto references = references_.subspan(first, count);
        const LaneBox box = box_around(references);
        std::memcpy(&nodes_[node], &box, sizeof(BinaryNode));
        nodes_[node].first = first;
        nodes_[node].count = count;
        if (count == 1) return;
        const std::uint32_t left_count = part(references, !leaves_room(depth, count - 1, settings_.most_height));
        build(first, left_count, node + 1, depth + 1);
        build(first + left_count, count - left_count, node + 1 + subtree_nodes(left_count), depth + 1);
    }

private:
    /// Sorts the references and answers with how many of them go left.
    std::uint32_t part(std::span<Reference> references, bool must_balance) {
        const auto count = static_cast<std::uint32_t>(references.size());
        if (!must_balance && rule_ >= Textbook::minimum_sum) return part_by_objective(references);
        const unsigned axis = widest_axis(references);
        std::sort(references.begin(), references.end(), ByCenter{axis});
        if (must_balance || rule_ == Textbook::object_median) return count / 2;
        const double ends = double(center_of(references.front(), axis)) + double(center_of(references.back(), axis));
        const double place = rule_ == Textbook::object_mean ? mean_center(references, axis) : ends / 2.0;
        const std::uint32_t left_count = count_before(references, axis, place);
        return left_count == 0 || left_count == count ? count / 2 : left_count;
    }

    std::uint32_t part_by_objective(std::span<Reference> references) {
        const auto count = static_cast<std::uint32_t>(references.size());
        double best = std::numeric_limits<double>::infinity();
        unsigned best_axis = 0;
        std::uint32_t best_left = count / 2;
        const auto from_middle = [&](std::uint32_t left) {
            return left < count / 2 ? count / 2 - left : left - count / 2;
        };
        for (unsigned axis = 0; axis < 3; ++axis) {
            std::sort(references.begin(), references.end(), ByCenter{axis});
            LaneBox right;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                right.add(lane_box_of(references[i]));
                right_boxes_[i] = right;
            }
            LaneBox left;
            for (std::uint32_t i = 1; i < count; ++i) {
                left.add(lane_box_of(references[i - 1]));
                const double here = objective(rule_, axis, left, right_boxes_[i]);
                if (here < best || (here == best && from_middle(i) < from_middle(best_left))) {
                    best = here;
                    best_axis = axis;
                    best_left = i;
                }
            }
        }
        if (best_axis != 2) std::sort(references.begin(), references.end(), ByCenter{best_axis});
        return best_left;
    }

    std::span<Reference> references_;
    Textbook rule_;
    const BuildSettings& settings_;
    BinaryNode* nodes_;
    std::vector<LaneBox> right_boxes_;
};

}  // namespace

baker::BinaryTree build_textbook(const baker::LatticeMesh& mesh, Textbook rule, const baker::BuildSettings& settings) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    std::vector<Reference> references(count);
    for (std::uint32_t i = 0; i < count; ++i) put_reference(mesh, i, references[i]);
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    TextbookBuilder(references, rule, settings, tree.nodes.get()).build(0, count, 0, 0);
    for (const Reference& reference : references) tree.triangles.push_back(reference.triangle);
    return tree;
}

}  // namespace espalier::bench
