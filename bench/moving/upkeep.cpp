#include "upkeep.hpp"

#include <algorithm>

#include "own_tree.hpp"
#include "systems/espalier_boxes.hpp"
#include "table.hpp"

namespace espalier::bench {

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
    std::fprintf(
        stderr,
        "tree after %zu steps: area / fresh SAH %.3f to %.3f between two repacks, fill %.2f (fresh %.2f), depth "
        "%zu (fresh %zu)\n",
        steps, *best, *worst, own.fill, fresh.fill, own.depth, fresh.depth);
    std::fprintf(stderr, "counted work (nodes written + tests of boxes): median %.0f, slowest / median %.2f\n",
                 median_of(work), slowest);
    JsonObject row = row_of(scenario, "upkeep");
    row.add("aged_steps", steps);
    row.add("area_to_fresh_best", *best, 4);
    row.add("area_to_fresh_worst", *worst, 4);
    row.add("fill", own.fill, 3);
    row.add("fresh_fill", fresh.fill, 3);
    row.add("depth", own.depth);
    row.add("median_work", median_of(work), 0);
    row.add("slowest_to_median_work", slowest, 3);
    row.print();
}

}  // namespace espalier::bench
