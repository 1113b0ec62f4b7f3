// Oriented bounding boxes (OBB): how well and how fast each fit encloses triangles, and trees of them beside trees of
// axis-aligned boxes (AABB) for two meshes. One thread; one JSON object a line.

#include "../study/study.hpp"
#include "box_trees.hpp"
#include "fits.hpp"

namespace espalier::bench {
namespace {

struct Options {
    std::size_t set_triangles = 40'000;  ///< of all measured sets of one size together, at most
    std::size_t poses = 60;
    std::size_t parallel_poses = 3;
    double gap = 0.005;  ///< between parallel surfaces, as a share of the bounding sphere's radius
    std::size_t rounds = 3;
};

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
    TriangleSet set = {corners_in(tree, range), range.end - range.first};
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

void print(const TreeSubject& subject, const SetsOfSize& sets, std::span<const FitRun> runs) {
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
        JsonObject row = guide_row("obb fits", subject.mesh.name, subject.tree().triangles.size());
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

/// Prints a row for each size of set and each fit.
void measure_fits(const TreeSubject& subject, const Options& options) {
    const AabbTree& tree = subject.tree();
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
}

/// Shakes the second mesh by less than a quarter of the gap.
std::vector<Transform> shaken(const Transform& pose, double gap, std::size_t count) {
    tests::Random random(seed);
    std::vector<Transform> poses(count, pose);
    for (Transform& each : poses) each.translation = random.in_cube(static_cast<float>(0.14 * gap));
    return poses;
}

/// Prints a row for each question and kind of tree.
void measure(const TreeSubject& subject, const MeshTrees& first, const MeshTrees& second, const PoseClass& poses,
             std::span<const PairQuestion> questions, std::size_t rounds) {
    for (const PairQuestion question : questions) {
        std::vector<PairRun> runs;
        for (const TreeKind& kind : all_tree_kinds())
            runs.push_back({std::string("trees of ") + kind.boxes + " on the topology " + kind.topology,
                            pairs_by(kind.walk(first, second, question))});
        take_turns(subject.mesh.name, runs, poses.poses, rounds);
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const TreeKind& kind = all_tree_kinds()[k];
            const auto& timed = runs[k].timed;
            JsonObject row = guide_row("obb trees", subject.mesh.name, subject.tree().triangles.size());
            row.add("poses_are", poses.name);
            row.add("question", question == PairQuestion::any ? "any" : "all");
            row.add("topology", kind.topology);
            row.add("boxes", kind.boxes);
            row.add("poses", poses.poses.size());
            row.add("pairs", timed.mean(timed.work.pairs), 2);
            row.add("box_tests", timed.mean(timed.work.box_tests), 1);
            row.add("triangle_tests", timed.mean(timed.work.triangle_tests), 1);
            add_spread(row, "ns", timed.nanoseconds, 0);
            row.add("node_bytes", kind.node_bytes);
            row.print();
        }
    }
}

void print_build(const TreeSubject& subject, const char* topology, const char* boxes, double seconds) {
    JsonObject row = guide_row("obb builds", subject.mesh.name, subject.tree().triangles.size());
    row.add("topology", topology);
    row.add("boxes", boxes);
    row.add("build_ms", 1e3 * seconds, 3);
    row.print();
}

/// Prints a row for each class of poses, question and kind of tree. Throws std::runtime_error if a tree has other
/// answers than the others.
void measure_trees(const TreeSubject& subject, const Options& options) {
    const double sah_seconds = subject.built.build_seconds;
    BuildSeconds seconds;
    const MeshTrees trees(subject.tree(), seconds);
    print_build(subject, "sah", "aabb", sah_seconds);
    print_build(subject, "sah", "obb", sah_seconds + seconds.fit);
    print_build(subject, "obb", "obb", seconds.obb_tree);
    constexpr std::array questions = {PairQuestion::any, PairQuestion::all};
    for (const PoseClass& poses : classes_of_poses(subject, options.poses))
        measure(subject, trees, trees, poses, questions, options.rounds);
    const double gap = options.gap * static_cast<double>(bounding_sphere(subject.mesh).radius);
    const ParallelSurface parallel = parallel_surface_of(subject.mesh, gap);
    const AabbTree second = build_tree_and_blob(parallel.mesh, 1).tree;
    const MeshTrees second_trees(second, seconds);
    const PoseClass poses = {"parallel", shaken(parallel.pose, gap, options.parallel_poses)};
    measure(subject, trees, second_trees, poses, std::span(questions).last(1), options.rounds);
}

}  // namespace

const Subcommand subcommand("obb", [](int count, char** words) {
    Options options;
    bool is_without_trees = false;
    Program program("espalier_bench_study obb",
                    "Oriented bounding boxes: fits, and trees of them beside trees of AABBs; JSON");
    program.add_count("--set-triangles", options.set_triangles, "Triangles of all measured sets of one size together");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--parallel-poses", options.parallel_poses, "Poses in which the surfaces are parallel");
    program.add_number("--gap", options.gap, 1e-4, 1.0, "Gap between parallel surfaces, in radii of the mesh");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    program.add_flag("--fits-only", is_without_trees, "Measure no trees");
    return program.run_on_meshes(count, words, [&](Mesh mesh) {
        const TreeSubject subject(std::move(mesh), 1);
        measure_fits(subject, options);
        if (!is_without_trees) measure_trees(subject, options);
    });
});

}  // namespace espalier::bench
