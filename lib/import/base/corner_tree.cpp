#include <import/base/corner_tree.hpp>

#include <algorithm>
#include <numeric>

namespace espalier::importer {

namespace {

constexpr std::uint32_t leaf_corners = 8;

/// Tests whether each point of a box is to the right of the line from a to b. Rounded differences and products rise or
/// fall with a coordinate as exact ones do, so the box's own corner that is farthest to the left decides for all of it.
bool is_right_of(const PlanePoint& low, const PlanePoint& high, const PlanePoint& a, const PlanePoint& b) {
    const PlanePoint farthest{b[1] - a[1] > 0.0 ? low[0] : high[0], b[0] - a[0] > 0.0 ? high[1] : low[1]};
    return plane_area(a, b, farthest) < 0.0;
}

}  // namespace

/// Around a triangle, with a margin beyond which rounding takes no point for one inside: with h as the least height of
/// the triangle and L as its box's size, a point at a distance d is behind one of its sides by an area of h d / 2 or
/// more, and an area is rounded by less than 2^-49 L (L + d). Infinite for a triangle that is too thin for that.
CornerTree::Box CornerTree::box_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double margin = 1e-6, least_area = 1e-7;
    Box box{a, a};
    grow(box, b);
    grow(box, c);
    const double size = (box.high[0] - box.low[0]) + (box.high[1] - box.low[1]);
    if (!(plane_area(a, b, c) >= least_area * size * size)) return {{-infinity, -infinity}, {infinity, infinity}};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        box.low[axis] -= margin * size;
        box.high[axis] += margin * size;
    }
    return box;
}

void CornerTree::grow(Box& box, const PlanePoint& point) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        box.low[axis] = std::min(box.low[axis], point[axis]);
        box.high[axis] = std::max(box.high[axis], point[axis]);
    }
}

void CornerTree::build(const std::vector<PlanePoint>& points) {
    points_ = &points;
    const auto corners = static_cast<std::uint32_t>(points.size());
    order_.resize(corners);
    std::iota(order_.begin(), order_.end(), 0u);
    leaves_.assign(corners, 0);
    counts_.assign(corners, 0);
    nodes_.clear();
    split(0, 0, corners);
}

/// The halves differ by one corner at most, so that no polygon makes the tree deep.
void CornerTree::split(std::size_t node, std::uint32_t begin, std::uint32_t end) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    nodes_[node] = {{{infinity, infinity}, {-infinity, -infinity}}, begin, end, 0};
    Box box{(*points_)[order_[begin]], (*points_)[order_[begin]]};
    for (std::uint32_t i = begin; i < end; ++i) grow(box, (*points_)[order_[i]]);
    if (end - begin <= leaf_corners || box.low == box.high) {
        for (std::uint32_t i = begin; i < end; ++i) leaves_[order_[i]] = static_cast<std::uint32_t>(node);
        return;
    }
    const std::size_t axis = box.high[0] - box.low[0] < box.high[1] - box.low[1] ? 1 : 0;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return (*points_)[a][axis] < (*points_)[b][axis]; });
    split(2 * node + 1, begin, middle);
    split(2 * node + 2, middle, end);
}

void CornerTree::set_counts(std::uint32_t corner, bool counts) {
    if (this->counts(corner) == counts) return;
    counts_[corner] = counts ? 1 : 0;
    for (std::size_t number = leaves_[corner];; number = (number - 1) / 2) {
        Node& node = nodes_[number];
        if (counts) {
            ++node.counting;
            grow(node.box, (*points_)[corner]);
        } else {
            --node.counting;
        }
        if (number == 0) return;
    }
}

std::uint32_t CornerTree::find_inside(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                                      std::uint64_t& steps) const {
    const Box near = box_of(a, b, c);
    open_.assign(1, 0);
    while (!open_.empty()) {
        const std::uint32_t number = open_.back();
        const auto& [box, begin, end, counting] = nodes_[number];
        open_.pop_back();
        ++steps;
        if (counting == 0 || box.low[0] > near.high[0] || box.high[0] < near.low[0] || box.low[1] > near.high[1] ||
            box.high[1] < near.low[1] || is_right_of(box.low, box.high, a, b) || is_right_of(box.low, box.high, b, c) ||
            is_right_of(box.low, box.high, c, a))
            continue;
        if (leaves_[order_[begin]] != number) {
            open_.push_back(2 * number + 2);
            open_.push_back(2 * number + 1);
            continue;
        }
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t corner = order_[i];
            const PlanePoint& point = (*points_)[corner];
            ++steps;
            if (!counts(corner)) continue;
            const bool is_own = point == a || point == b || point == c;
            if (!is_own && plane_area(a, b, point) >= 0.0 && plane_area(b, c, point) >= 0.0 &&
                plane_area(c, a, point) >= 0.0)
                return corner;
            if (box.low == box.high) break;  // all that count lie there
        }
    }
    return none;
}

}  // namespace espalier::importer
