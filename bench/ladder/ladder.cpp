// How small can a tree be? Terdiman's ladder from the complete tree to the quantised one without leaf nodes, and trees
// of degree 2, 4, 8 and 16: bytes, work and time of rays and boxes, beside Espalier's own. One thread; one JSON object
// a line.

#include "../study/study.hpp"
#include "systems.hpp"
#include "walk.hpp"

namespace espalier::bench {
namespace {

struct LadderOptions {
    unsigned leaf_triangles = 4;
    std::size_t rays = 20'000;
    std::size_t boxes = 2'000;
    std::size_t recounted = 100;
    std::size_t rounds = 5;
};

/// The answers of a blob are exact, those of the others are not: at the edges of triangles they may differ, and so may
/// t within its rounding.
constexpr double most_differing_share = 0.001;
constexpr float most_relative_difference = 1e-5f;

struct Queries {
    std::vector<Ray> rays;
    std::vector<Aabb> boxes;
    std::vector<std::vector<TriangleOnRay>> hits;  ///< of the first rays, which are counted twice

    [[nodiscard]] std::span<const Ray> recounted_rays() const { return std::span(rays).first(hits.size()); }
    [[nodiscard]] std::span<const Aabb> recounted_boxes() const {
        return std::span(boxes).first(std::min(hits.size(), boxes.size()));
    }
};

/// A system, its answers, and what they took.
struct Run {
    const char* measures;
    TreeSystem* system;
    Timed<float, TreeWork> rays = {};           ///< t of the closest hit
    Timed<std::uint64_t, TreeWork> boxes = {};  ///< how many triangles touch
};

void make_round(Run& run, const Queries& queries) {
    run.rays.make_round(queries.rays, [&](const Ray& ray, TreeWork&) { return run.system->closest(ray, nullptr); });
    run.boxes.make_round(queries.boxes,
                         [&](const Aabb& box, TreeWork&) { return run.system->count_touching(box, nullptr); });
}

/// Asks once more, and counts the work.
void count_work(Run& run, const Queries& queries) {
    for (const Ray& ray : queries.rays) static_cast<void>(run.system->closest(ray, &run.rays.work));
    for (const Aabb& box : queries.boxes) static_cast<void>(run.system->count_touching(box, &run.boxes.work));
}

bool are_equal(float a, float b, bool exactly) {
    if (exactly || !std::isfinite(a) || !std::isfinite(b)) return a == b;
    return std::abs(a - b) <= most_relative_difference * std::max(std::abs(a), std::abs(b));
}

struct Difference {
    std::size_t rays = 0;
    std::size_t boxes = 0;
};

Difference difference(const Run& run, const Run& reference) {
    Difference found{0, run.boxes.differing(reference.boxes)};
    for (std::size_t i = 0; i < run.rays.answers.size(); ++i)
        found.rays += are_equal(run.rays.answers[i], reference.rays.answers[i], run.system->is_textbook()) ? 0u : 1u;
    return found;
}

void check_answers(const std::string& mesh, const Run& run, const Run& reference) {
    const Difference found = difference(run, reference);
    const double most = run.system->is_textbook() ? 0.0 : most_differing_share;
    if (static_cast<double>(found.rays) > most * static_cast<double>(run.rays.answers.size()) ||
        static_cast<double>(found.boxes) > most * static_cast<double>(run.boxes.answers.size()))
        throw std::runtime_error(mesh + ": " + run.system->name() + " has other answers than " +
                                 reference.system->name());
}

/// Tests the first answers against loops over all triangles.
void check_by_loops(const Mesh& mesh, const Run& run, const Queries& queries) {
    for (std::size_t i = 0; i < queries.hits.size(); ++i) {
        float nearest = no_hit;
        for (const TriangleOnRay& hit : queries.hits[i]) nearest = std::min(nearest, hit.t);
        if (run.rays.answers[i] != nearest)
            throw std::runtime_error(mesh.name + ": a ray has another hit than the loop finds");
    }
    const std::vector<FloatTriangle> triangles = triangles_of(mesh);
    for (std::size_t i = 0; i < queries.recounted_boxes().size(); ++i)
        if (run.boxes.answers[i] != touching_of_all(triangles, queries.boxes[i]))
            throw std::runtime_error(mesh.name + ": a box touches other triangles than the loop finds");
}

template <class Answer>
void add_work(JsonObject& row, const std::string& query, const Timed<Answer, TreeWork>& timed, bool has_boxes) {
    const TreeWork& work = timed.work;
    row.add("nodes_per_" + query, timed.mean(work.nodes), 2);
    row.add("leaves_per_" + query, timed.mean(work.leaves), 2);
    row.add("box_tests_per_" + query, has_boxes ? std::optional(timed.mean(work.box_tests)) : std::nullopt, 2);
    row.add("triangle_tests_per_" + query, timed.mean(work.triangle_tests), 2);
}

void print(const LadderSubject& subject, const Run& run, const Run& reference, const Queries& queries,
           const LadderOptions& options) {
    const auto triangles = static_cast<double>(subject.mesh.triangles.size());
    const TreeBytes bytes = run.system->bytes();
    const auto tree_bytes = static_cast<double>(bytes.nodes * bytes.node_bytes);
    const Difference differing = difference(run, reference);
    JsonObject row = guide_row(run.measures, subject.mesh.name, subject.mesh.triangles.size());
    row.add("tree", run.system->name());
    row.add("degree", std::size_t{run.system->degree()});
    row.add("leaf_triangles", std::size_t{options.leaf_triangles});
    row.add("nodes", bytes.nodes);
    row.add("node_bytes", bytes.node_bytes);
    row.add("bytes_per_triangle", tree_bytes / triangles, 2);
    row.add("all_bytes_per_triangle", static_cast<double>(bytes.all_bytes) / triangles, 2);
    row.add("rays", queries.rays.size());
    add_work(row, "ray", run.rays, run.system->is_textbook());
    add_spread(row, "ns_per_ray", run.rays.nanoseconds, 1);
    row.add("boxes", queries.boxes.size());
    add_work(row, "box", run.boxes, true);
    double touching = 0.0;
    for (const std::uint64_t count : run.boxes.answers) touching += static_cast<double>(count);
    row.add("touching_per_box", touching / static_cast<double>(queries.boxes.size()), 2);
    add_spread(row, "ns_per_box", run.boxes.nanoseconds, 0);
    row.add("rays_that_differ", differing.rays);
    row.add("boxes_that_differ", differing.boxes);
    row.add("counted_twice", queries.hits.size());
    row.add("rounds", options.rounds);
    row.print();
}

Queries make_queries(const LadderSubject& subject, const LadderOptions& options) {
    Queries queries{
        incoherent_rays(subject.mesh, options.rays, seed), boxes_on_surface(subject, options.boxes, seed), {}};
    for (std::size_t i = 0; i < std::min(options.recounted, options.rays); ++i)
        queries.hits.push_back(triangles_on(queries.rays[i], subject.mesh));
    return queries;
}

/// Prints a row for each step of the ladder and for each degree. Throws std::runtime_error if a tree has other answers
/// than the others, or if two counters differ for one of the first `recounted` rays and boxes.
void measure_ladder(Mesh mesh, const LadderOptions& options) {
    const LadderSubject subject = make_subject(std::move(mesh));
    const LadderShapes shapes(subject, options.leaf_triangles);
    const Queries queries = make_queries(subject, options);
    const TreeSystems steps = ladder_systems(subject, shapes), degrees = degree_systems(subject, shapes);
    std::vector<Run> runs;
    for (const auto& system : steps) runs.push_back({"ladder", system.get()});
    for (const auto& system : degrees) runs.push_back({"degree", system.get()});
    for (Run& run : runs) run.system->recount(queries.recounted_rays(), queries.hits, queries.recounted_boxes());
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (Run& run : runs) make_round(run, queries);
    check_by_loops(subject.mesh, runs.front(), queries);
    for (const Run& run : runs) check_answers(subject.mesh.name, run, runs.front());
    for (Run& run : runs) count_work(run, queries);
    for (const Run& run : runs) print(subject, run, runs.front(), queries, options);
}

}  // namespace

const Subcommand subcommand("ladder", [](int count, char** words) {
    LadderOptions options;
    Program program("espalier_bench_study ladder",
                    "Layouts and degrees of trees: bytes, work and time of queries; JSON");
    program.add_number("--leaf-size", options.leaf_triangles, 1u, 16u,
                       "Triangles in a leaf, at most, of trees that have several");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--boxes", options.boxes, "Boxes on the surface");
    program.add_count("--recounted", options.recounted, "Rays and boxes that are counted by a second counter");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run_on_meshes(count, words, [&](Mesh mesh) { measure_ladder(std::move(mesh), options); });
});

}  // namespace espalier::bench
