#include "churn.hpp"

#include <algorithm>
#include <cmath>

#include "../../tests/runtime/moving_scenes/made_block.hpp"
#include "own_tree.hpp"
#include "table.hpp"
#include "thread_time.hpp"

namespace espalier::bench {
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
    tests::Random random_{moving_seed};
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

    tests::Random random(moving_seed + 1);
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

    std::fprintf(stderr, "churn: %u %s, %zu removals and insertions\n", objects,
                 scenario.sizes == Sizes::cubes ? "cubes" : "mixed cubes", operations);
    std::fprintf(stderr, "area / fresh SAH %.3f (packed %.3f), fill %.2f (fresh %.2f), depth %zu (packed %zu)\n",
                 own.area / fresh.area, packed.area / fresh.area, own.fill, fresh.fill, deepest, packed.depth);
    std::fprintf(stderr, "insert %.3f us, remove %.3f us; the slowest mean of %zu in a row %.2f us and %.2f us\n",
                 inserts.microseconds(), removals.microseconds(), size, inserts.slowest_microseconds(),
                 removals.slowest_microseconds());
    JsonObject row = row_of(scenario, "churn");
    row.add("operations", operations);
    row.add("area_to_fresh", own.area / fresh.area, 4);
    row.add("packed_area_to_fresh", packed.area / fresh.area, 4);
    row.add("fill", own.fill, 3);
    row.add("fresh_fill", fresh.fill, 3);
    row.add("deepest", deepest);
    row.add("insert_us", inserts.microseconds(), 4);
    row.add("remove_us", removals.microseconds(), 4);
    row.print();
}

}  // namespace espalier::bench
