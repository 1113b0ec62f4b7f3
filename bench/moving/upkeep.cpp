// A tree over boxes that is built with all of them at hand, for comparison.

#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/moving_scenes/box_tree/self_join.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

#include "../../tests/runtime/moving_scenes/made_block.hpp"
#include "../deformation/box_tree.hpp"
#include "espalier.hpp"
#include "turns.hpp"

namespace espalier::bench::moving {
namespace {

/// What a tree with up to eight children a node is like.
struct TreeShape {
    double area = 0.0;  ///< the sum of half the surfaces of all boxes in nodes, for each object
    double fill = 0.0;  ///< children of a node, the mean
    std::size_t nodes = 0;
    std::size_t depth = 0;  ///< nodes on the longest way
};

// What the tree of a moving scene is like, and what a step costs it, in counts.

constexpr std::size_t width = 8;

Aabb aabb_of(const Box& b) { return {{b.min.x, b.min.y, b.min.z}, {b.max.x, b.max.y, b.max.z}}; }

/// Some of the objects: they follow one another in the builder's order.
struct Range {
    std::size_t first, last;
    Aabb box;
    [[nodiscard]] std::size_t count() const { return last - first; }
};

class Builder {
public:
    explicit Builder(std::span<const Box> boxes) : order_(boxes.size()) {
        for (const Box& box : boxes) boxes_.push_back(aabb_of(box));
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        build(range(0, order_.size()), 1);
        shape_.area = sum_ / static_cast<double>(boxes.size());
        shape_.fill = static_cast<double>(boxes.size() + shape_.nodes - 1) / static_cast<double>(shape_.nodes);
    }
    [[nodiscard]] const TreeShape& shape() const { return shape_; }

private:
    [[nodiscard]] Range range(std::size_t first, std::size_t last) const {
        Range result = {first, last, Aabb::none()};
        for (std::size_t i = first; i < last; ++i) result.box.add(boxes_[order_[i]]);
        return result;
    }
    void build(const Range& all, std::size_t depth) {
        ++shape_.nodes;
        shape_.depth = std::max(shape_.depth, depth);
        if (all.count() <= width) {
            for (std::size_t i = all.first; i < all.last; ++i) sum_ += boxes_[order_[i]].half_area();
            return;
        }
        std::vector<Range> parts = {all};
        while (parts.size() < width) {
            Range* largest = nullptr;
            for (Range& part : parts)
                if (part.count() > width && (largest == nullptr || part.box.half_area() > largest->box.half_area()))
                    largest = &part;
            if (largest == nullptr) break;
            const std::size_t last = largest->last;
            const std::size_t middle =
                largest->first + split_by_areas(std::span(order_).subspan(largest->first, largest->count()),
                                                std::span<const Aabb>(boxes_), weight);
            *largest = range(largest->first, middle);
            parts.push_back(range(middle, last));
        }
        for (const Range& part : parts) {
            sum_ += part.box.half_area();
            if (part.count() > 1) build(part, depth + 1);
        }
    }
    /// Counts objects in whole leaf nodes, so that these become full.
    static double weight(std::size_t objects) { return static_cast<double>((objects + width - 1) / width); }

    std::vector<Aabb> boxes_;
    std::vector<std::size_t> order_;
    TreeShape shape_;
    double sum_ = 0.0;
};

/// Builds a tree from the top down: the largest part of a node is split in two at the best of 16 bins along each axis
/// (surface area heuristic), until there are eight parts or none has more than eight objects.
TreeShape fresh_tree(std::span<const Box> boxes) { return Builder(boxes).shape(); }

/// Returns its shape; areas are in squares of the length whose exponent is that of the steps.
TreeShape shape_of(const detail::SceneBlock& block, int step_exponent) {
    const detail::BlockHead& head = *block.head;
    TreeShape shape;
    shape.area = std::ldexp(static_cast<double>(detail::area_of_boxes(block)), 2 * step_exponent);
    shape.nodes = head.nodes_used - head.free_nodes;
    shape.fill = static_cast<double>(head.live + shape.nodes - 1) / static_cast<double>(shape.nodes);
    shape.depth = head.levels;
    return shape;
}

/// Returns how many tests of a box against a node's boxes the search for pairs took in the step that ended last: for
/// all pairs, or those in which something moved.
std::uint64_t count_box_tests(const detail::SceneBlock& block, bool only_moved) {
    detail::BlockHead head = *block.head;
    --head.step;
    detail::SceneBlock last_step = block;
    last_step.head = &head;
    SceneCounters counters;
    const auto ignore = [](std::span<const InstancePair>) {};
    const detail::JoinedSlots joined = only_moved ? detail::JoinedSlots::moved : detail::JoinedSlots::all;
    detail::count_join(last_step, joined, 0, ignore, counters);
    return counters.box_tests;
}

}  // namespace

void print_upkeep(const Scenario& scenario, std::size_t steps) {
    const BakeResult cube = baked_cube();
    Frames frames(scenario, cube);
    const Start start = frames.start();
    const bool only_moved = scenario.moving < 1.0;
    EspalierBoxes ours(start, only_moved);
    PairList pairs(start.most_pairs);
    Parts parts;
    Frame frame;
    Steps work, to_fresh;
    TreeShape own, fresh;
    for (std::size_t step = 0; step < steps; ++step) {
        frames.next(frame);
        ours.step(frame, parts, pairs);
        work.push_back(static_cast<double>(ours.nodes_renewed() + count_box_tests(ours.block(), only_moved)));
        if (step + scenario.steps_between_repacks() < steps) continue;
        own = shape_of(ours.block(), start.step_exponent);
        fresh = fresh_tree(frame.boxes);
        to_fresh.push_back(own.area / fresh.area);
    }
    const auto [best, worst] = std::minmax_element(to_fresh.begin(), to_fresh.end());
    const double slowest = slowest_of(work) / median_of(work);
    JsonObject row = row_of(scenario, "upkeep");
    row.add("aged_steps", steps);
    row.add("area_to_fresh_best", *best, 4);
    row.add("area_to_fresh_worst", *worst, 4);
    row.add("fill", own.fill, 3);
    row.add("fresh_fill", fresh.fill, 3);
    row.add("depth", own.depth);
    row.add("fresh_depth", fresh.depth);
    row.add("median_work", median_of(work), 0);
    row.add("slowest_to_median_work", slowest, 3);
    row.print();
}

namespace {

constexpr std::size_t batch = 128;
constexpr int step_exponent = -10;

/// Cubes of the sizes of a scenario, anywhere in its world.
class Boxes {
public:
    explicit Boxes(const Scenario& scenario) : motion_(scenario) {}
    [[nodiscard]] detail::StepsBox any() {
        const std::vector<float>& edges = motion_.edges();
        const float edge = edges[random_.below(static_cast<std::uint32_t>(edges.size()))];
        const float room = motion_.side() - edge;
        const float at[3] = {room * random_.unit(), room * random_.unit(), room * random_.unit()};
        detail::StepsBox box{};
        for (int k = 0; k < 3; ++k) {
            box.low[k] = static_cast<std::int32_t>(std::ldexp(at[k], -step_exponent));
            box.high[k] = static_cast<std::int32_t>(std::ldexp(at[k] + edge, -step_exponent));
        }
        return box;
    }

private:
    Motion motion_;
    tests::Random random_{seed};
};

TreeShape fresh_shape(const detail::SceneBlock& block) {
    std::vector<Box> boxes;
    for (std::uint32_t slot = 0; slot < block.head->slots_used; ++slot) {
        if (!detail::is_live(block.slots[slot])) continue;
        const detail::StepsBox& box = block.slots[slot].box;
        const auto length = [](std::int32_t steps) { return std::ldexp(static_cast<float>(steps), step_exponent); };
        boxes.push_back({{length(box.low[0]), length(box.low[1]), length(box.low[2])},
                         {length(box.high[0]), length(box.high[1]), length(box.high[2])}});
    }
    return fresh_tree(boxes);
}

/// The time of many operations.
struct Times {
    double seconds = 0.0;
    double slowest_batch = 0.0;
    std::size_t count = 0;
    std::size_t largest_batch = 1;
    void add(double batch_seconds, std::size_t operations) {
        seconds += batch_seconds;
        slowest_batch = std::max(slowest_batch, batch_seconds);
        count += operations;
        largest_batch = std::max(largest_batch, operations);
    }
    [[nodiscard]] double microseconds() const { return 1e6 * seconds / static_cast<double>(count); }
    [[nodiscard]] double slowest_microseconds() const {
        return 1e6 * slowest_batch / static_cast<double>(largest_batch);
    }
};

}  // namespace

void print_churn(const Scenario& scenario, std::size_t operations) {
    const auto objects = static_cast<std::uint32_t>(scenario.objects);
    Boxes boxes(scenario);
    tests::MadeBlock made(objects);
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < objects; ++i) slots.push_back(made.insert(boxes.any()));

    tests::Random random(seed + 1);
    Times inserts, removals;
    std::size_t deepest = made.block.head->levels;
    const std::size_t size = std::min<std::size_t>(batch, objects);
    std::vector<detail::StepsBox> next(size);
    std::vector<std::uint32_t> chosen(size);
    for (std::size_t done = 0; done < operations; done += size) {
        // The chosen slots are drawn and the boxes made before the measurement.
        for (std::size_t i = 0; i < size; ++i) {
            std::swap(slots[i], slots[i + random.below(static_cast<std::uint32_t>(objects - i))]);
            next[i] = boxes.any();
        }
        const double begin = thread_seconds();
        for (std::size_t i = 0; i < size; ++i) made.remove(slots[i]);
        const double middle = thread_seconds();
        for (std::size_t i = 0; i < size; ++i) slots[i] = made.insert(next[i]);
        const double end = thread_seconds();
        removals.add(middle - begin, size);
        inserts.add(end - middle, size);
        deepest = std::max<std::size_t>(deepest, made.block.head->levels);
    }
    const TreeShape own = shape_of(made.block, step_exponent), fresh = fresh_shape(made.block);
    detail::repack_boxes(made.block);
    const TreeShape packed = shape_of(made.block, step_exponent);

    JsonObject row = row_of(scenario, "churn");
    row.add("operations", operations);
    row.add("area_to_fresh", own.area / fresh.area, 4);
    row.add("packed_area_to_fresh", packed.area / fresh.area, 4);
    row.add("fill", own.fill, 3);
    row.add("fresh_fill", fresh.fill, 3);
    row.add("deepest", deepest);
    row.add("packed_depth", packed.depth);
    row.add("insert_us", inserts.microseconds(), 4);
    row.add("slowest_insert_us", inserts.slowest_microseconds(), 4);
    row.add("remove_us", removals.microseconds(), 4);
    row.add("slowest_remove_us", removals.slowest_microseconds(), 4);
    row.print();
}

}  // namespace espalier::bench::moving
