// Boxes around the triangles of a tree's nodes, by each fit.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "../deformation/processor_time.hpp"
#include "../deformation/spread.hpp"
#include "../guide/row.hpp"
#include "../traversal/corners.hpp"
#include "box_trees.hpp"
#include "fits.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

/// Triangles of a node of the tree, as the distinct corners that they have.
struct TriangleSet {
    std::vector<Point> points;
    std::size_t triangles = 0;
};

struct SetsOfSize {
    std::string size;
    std::vector<TriangleSet> sets;
};

TriangleSet set_of(const AabbTree& tree, const TriangleRange& range) {
    TriangleSet set;
    set.triangles = range.end - range.first;
    for (std::size_t i = range.first; i < range.end; ++i)
        for (const Vec3& corner : tree.triangles[i]) set.points.push_back(point_of(corner));
    const auto is_before = [](const Point& a, const Point& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::sort(set.points.begin(), set.points.end(), is_before);
    const auto is_same = [](const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    set.points.erase(std::unique(set.points.begin(), set.points.end(), is_same), set.points.end());
    return set;
}

/// Returns the triangles of nodes that have at most `size`, and at least half as many, while their parent has more.
/// Where these are too many, it is each n-th.
std::vector<TriangleSet> sets_of_size(const AabbTree& tree, std::size_t size, std::size_t most_triangles) {
    const std::vector<TriangleRange> ranges = triangle_ranges(tree);
    const auto count = [&](std::size_t node) { return ranges[node].end - ranges[node].first; };
    std::vector<TriangleRange> chosen;
    std::size_t triangles = 0;
    for (std::size_t node = 0; node < tree.nodes.size(); ++node) {
        if (tree.nodes[node].is_leaf() || count(node) <= size) continue;
        for (std::size_t child = tree.nodes[node].first; child < std::size_t{tree.nodes[node].first} + 2; ++child) {
            if (count(child) > size || 2 * count(child) < size) continue;
            chosen.push_back(ranges[child]);
            triangles += count(child);
        }
    }
    const std::size_t step = triangles / most_triangles + 1;
    std::vector<TriangleSet> sets;
    for (std::size_t i = 0; i < chosen.size(); i += step) sets.push_back(set_of(tree, chosen[i]));
    return sets;
}

double volume_of(const Block& box) { return 8.0 * box.half[0] * box.half[1] * box.half[2]; }
double area_of(const Block& box) {
    return 8.0 * (box.half[0] * box.half[1] + box.half[1] * box.half[2] + box.half[2] * box.half[0]);
}

/// What a fit made of all sets.
struct FitRun {
    std::vector<Block> boxes;
    std::vector<double> seconds;  ///< in each round
};

/// Returns whether a box is so thin that its volume is made of rounding.
bool is_flat(const Block& box) {
    const auto [thin, thick] = std::minmax_element(box.half.begin(), box.half.end());
    return *thin <= 1e-6 * *thick;
}

double sum(const std::vector<Block>& boxes, double (*size_of)(const Block&)) {
    double total = 0.0;
    for (const Block& box : boxes) total += size_of(box);
    return total;
}

std::vector<double> multiplied(std::vector<double> values, double factor) {
    for (double& value : values) value *= factor;
    return values;
}

void print(const ObbSubject& subject, const SetsOfSize& sets, std::span<const FitRun> runs) {
    std::vector<double> least(sets.sets.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> flat(least.size(), false);
    for (const FitRun& run : runs)
        for (std::size_t i = 0; i < least.size(); ++i) {
            least[i] = std::min(least[i], volume_of(run.boxes[i]));
            flat[i] = flat[i] || is_flat(run.boxes[i]);
        }
    double sum_of_least = 0.0, triangles = 0.0, points = 0.0;
    for (std::size_t i = 0; i < least.size(); ++i) {
        sum_of_least += least[i];
        triangles += static_cast<double>(sets.sets[i].triangles);
        points += static_cast<double>(sets.sets[i].points.size());
    }
    const auto count = static_cast<double>(sets.sets.size());
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const FitRun& run = runs[k];
        double worst = 1.0;
        for (std::size_t i = 0; i < least.size(); ++i)
            if (!flat[i]) worst = std::max(worst, volume_of(run.boxes[i]) / least[i]);
        JsonObject row = guide_row("obb fits", subject.mesh.name, subject.built.tree.triangles.size());
        row.add("size", sets.size);
        row.add("fit", std::string(name_of(all_box_fits[k])));
        row.add("sets", sets.sets.size());
        row.add("flat_sets", static_cast<std::size_t>(std::count(flat.begin(), flat.end(), true)));
        row.add("set_triangles", triangles / count, 1);
        row.add("set_points", points / count, 1);
        row.add("volume", sum(run.boxes, volume_of) / sum(runs[0].boxes, volume_of), 4);
        row.add("area", sum(run.boxes, area_of) / sum(runs[0].boxes, area_of), 4);
        row.add("over_least", sum(run.boxes, volume_of) / sum_of_least, 4);
        row.add("worst_over_least", worst, 3);
        add_spread(row, "set_us", multiplied(run.seconds, 1e6 / count), 3);
        add_spread(row, "triangle_ns", multiplied(run.seconds, 1e9 / triangles), 2);
        row.print();
    }
}

}  // namespace

void measure_fits(const ObbSubject& subject, const ObbOptions& options) {
    const AabbTree& tree = subject.built.tree;
    std::vector<SetsOfSize> sizes;
    for (const std::size_t size : {10u, 100u, 1000u})
        if (size < tree.triangles.size())
            sizes.push_back({std::to_string(size), sets_of_size(tree, size, options.set_triangles)});
    sizes.push_back({"all", {set_of(tree, {0, tree.triangles.size()})}});
    for (const SetsOfSize& sets : sizes) {
        if (sets.sets.empty()) continue;
        std::vector<FitRun> runs(all_box_fits.size());
        for (std::size_t round = 0; round < options.rounds; ++round)
            for (std::size_t k = 0; k < runs.size(); ++k) {
                runs[k].boxes.clear();
                const ProcessorTime time;
                for (const TriangleSet& set : sets.sets) runs[k].boxes.push_back(fit_box(all_box_fits[k], set.points));
                runs[k].seconds.push_back(time.seconds());
            }
        print(subject, sets, runs);
    }
    std::fflush(stdout);
}

}  // namespace espalier::bench
