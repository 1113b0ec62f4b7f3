#include <baker/scenes/instance_tree.hpp>

#include <algorithm>
#include <limits>

#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>

namespace espalier::baker {

namespace {

namespace layout = format::packed_node;

/// From this depth on ranges are split in halves: eight more levels then hold every scene.
constexpr unsigned first_even_depth = 8;
static_assert(1ull << 3 * (format::max_depth - first_even_depth) >= format::scene::max_instances);

void add(ChildBox& all, const ChildBox& box) {
    for (std::size_t k = 0; k < 3; ++k) {
        all.lo[k] = std::min(all.lo[k], box.lo[k]);
        all.hi[k] = std::max(all.hi[k], box.hi[k]);
    }
}

double half_area(const ChildBox& box) {
    const auto side = [&](std::size_t k) { return static_cast<double>(box.hi[k]) - box.lo[k]; };
    return side(0) * side(1) + side(1) * side(2) + side(2) * side(0);
}

/// Consecutive places of the order, which become a child.
struct Range {
    std::size_t begin;
    std::size_t end;
    ChildBox box;

    [[nodiscard]] std::size_t size() const { return end - begin; }
};

class Builder {
public:
    explicit Builder(std::span<const ChildBox> boxes) : boxes_(boxes), order_(boxes.size()) {
        for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
    }

    InstanceTree build() {
        if (boxes_.empty()) return {};
        tree_.nodes.resize(layout::bytes);
        put(0, range_of(0, order_.size()), 1);
        return std::move(tree_);
    }

private:
    [[nodiscard]] const ChildBox& box_at(std::size_t place) const { return boxes_[order_[place]]; }
    [[nodiscard]] Range range_of(std::size_t begin, std::size_t end) const {
        Range range{begin, end, box_at(begin)};
        for (std::size_t i = begin + 1; i < end; ++i) add(range.box, box_at(i));
        return range;
    }

    /// Twice the middle of a box along an axis.
    [[nodiscard]] std::int64_t middle(std::uint32_t index, std::size_t axis) const {
        return std::int64_t{boxes_[index].lo[axis]} + boxes_[index].hi[axis];
    }
    void sort(const Range& range, std::size_t axis) {
        const auto at = [&](std::size_t place) { return order_.begin() + static_cast<std::ptrdiff_t>(place); };
        std::sort(at(range.begin), at(range.end), [&](std::uint32_t a, std::uint32_t b) {
            const std::int64_t x = middle(a, axis), y = middle(b, axis);
            return x != y ? x < y : a < b;
        });
    }

    /// Sorts the range and returns where its second part begins.
    std::size_t split(const Range& range, bool is_even) {
        std::size_t best_axis = 0, best_place = range.begin + range.size() / 2;
        double best_cost = std::numeric_limits<double>::infinity();
        std::vector<double> areas(range.size());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sort(range, axis);
            ChildBox box = box_at(range.end - 1);
            for (std::size_t place = range.end - 1; place > range.begin; --place) {
                add(box, box_at(place));
                areas[place - range.begin] = half_area(box);
            }
            box = box_at(range.begin);
            for (std::size_t place = range.begin + 1; place < range.end; ++place) {
                add(box, box_at(place - 1));
                if (is_even && place != range.begin + range.size() / 2) continue;
                const double cost = half_area(box) * static_cast<double>(place - range.begin) +
                                    areas[place - range.begin] * static_cast<double>(range.end - place);
                if (cost >= best_cost) continue;
                best_cost = cost;
                best_axis = axis;
                best_place = place;
            }
        }
        sort(range, best_axis);
        return best_place;
    }

    /// Splits a range into at most eight: each time the one with the largest area, or the largest of all.
    std::vector<Range> children_of(const Range& range, unsigned depth) {
        const bool is_even = depth >= first_even_depth;
        std::vector<Range> children = {range};
        while (children.size() < layout::max_children) {
            const auto weight = [&](const Range& child) {
                if (child.size() == 1) return -1.0;
                return is_even ? static_cast<double>(child.size()) : half_area(child.box);
            };
            const auto largest =
                std::max_element(children.begin(), children.end(),
                                 [&](const Range& a, const Range& b) { return weight(a) < weight(b); });
            if (largest->size() == 1) break;
            const Range whole = *largest;
            const std::size_t place = split(whole, is_even);
            *largest = range_of(whole.begin, place);
            children.insert(largest + 1, range_of(place, whole.end));
        }
        std::stable_partition(children.begin(), children.end(), [](const Range& child) { return child.size() > 1; });
        return children;
    }

    /// Writes node `number` and all below it.
    void put(std::size_t number, const Range& range, unsigned depth) {
        tree_.depth = std::max(tree_.depth, depth);
        const std::vector<Range> children = children_of(range, depth);
        std::vector<ChildBox> boxes;
        boxes.reserve(children.size());
        for (const Range& child : children) boxes.push_back(child.box);
        const auto nodes = static_cast<std::size_t>(
            std::count_if(children.begin(), children.end(), [](const Range& child) { return child.size() > 1; }));
        const std::size_t leaves = children.size() - nodes, first_child = tree_.nodes.size() / layout::bytes;
        std::byte* const bytes = tree_.nodes.data() + number * layout::bytes;
        put_packed_boxes(boxes, format::scene::bits, bytes);
        set_u32(bytes + layout::children_at,
                static_cast<std::uint32_t>((nodes == 0 ? 0 : first_child) | nodes << 24 | leaves << 28));
        if (leaves != 0) set_u32(bytes + layout::leaf_block_at, static_cast<std::uint32_t>(tree_.order.size()));
        for (std::size_t i = nodes; i < children.size(); ++i) tree_.order.push_back(order_[children[i].begin]);
        tree_.nodes.resize(tree_.nodes.size() + nodes * layout::bytes);
        for (std::size_t i = 0; i < nodes; ++i) put(first_child + i, children[i], depth + 1);
    }

    std::span<const ChildBox> boxes_;
    std::vector<std::uint32_t> order_;
    InstanceTree tree_;
};

}  // namespace

InstanceTree build_instance_tree(std::span<const ChildBox> boxes) { return Builder(boxes).build(); }

}  // namespace espalier::baker
