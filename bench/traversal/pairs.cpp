// Two copies of a mesh in poses of three classes: apart, touching and deep in each other.
#include <cstdio>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include <espalier/pair.hpp>
#include <espalier/statistics.hpp>

#include "../deformation/processor_time.hpp"
#include "../deformation/spread.hpp"
#include "../guide/row.hpp"
#include "../pairs/poses.hpp"
#include "pair_walk.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

constexpr std::uint64_t seed = 2026;
constexpr WorkLimit unlimited = WorkLimit::unlimited();

struct PoseClass {
    const char* name;
    std::vector<Transform> poses;
};

constexpr const char* name_of(PairQuestion question) { return question == PairQuestion::any ? "any" : "all"; }

/// Moves the second mesh to a quarter of its distance from the middle of the first one.
Transform deeper(Transform pose, const Vec3& middle) {
    const Matrix matrix = rotation_matrix(pose);
    const double center[3] = {static_cast<double>(middle.x), static_cast<double>(middle.y),
                              static_cast<double>(middle.z)};
    float* const shift[3] = {&pose.translation.x, &pose.translation.y, &pose.translation.z};
    for (int k = 0; k < 3; ++k) {
        const auto& row = matrix.at[k];
        const double alone = center[k] - (row[0] * center[0] + row[1] * center[1] + row[2] * center[2]);
        *shift[k] = static_cast<float>(alone + 0.25 * (static_cast<double>(*shift[k]) - alone));
    }
    return pose;
}

std::vector<PoseClass> classes_of_poses(const Subject& subject, std::size_t count) {
    const auto touches = [&](const Transform& pose) {
        return overlaps(subject.blob, {subject.blob, pose}, unlimited).yes();
    };
    const Vec3 middle = bounding_sphere(subject.mesh).center;
    std::vector<PoseClass> classes = {{"apart", {}}, {"touching", {}}, {"deep", {}}};
    for (const Transform& pose : some_poses(subject.mesh, count, seed, touches)) {
        const bool is_touching = touches(pose);
        classes[is_touching ? 1 : 0].poses.push_back(pose);
        if (is_touching) classes[2].poses.push_back(deeper(pose, middle));
    }
    return classes;
}

/// A way to answer a question in all poses of a class, and what it took.
struct Run {
    std::string rule;
    std::function<PairWork(const Transform& pose)> answer;
    bool has_work;  ///< it counts tests
    bool is_exact;  ///< it must have the answers of the other such runs
    PairWork total;
    std::vector<std::uint64_t> pairs;  ///< of each pose
    std::vector<double> nanoseconds;   ///< of a pose, in each round
};

PairWork run_espalier(const Blob& blob, PairQuestion question, const Transform& pose) {
    PairWork work;
    PairCounters counters;
    QueryStatus status = QueryStatus::ok;
    if (question == PairQuestion::any) {
        const PairContact contact = first_contact(blob, {blob, pose}, unlimited, counters);
        status = contact.status;
        work = {counters.box_pairs, counters.triangle_pairs, contact ? 1u : 0u};
    } else {
        status = for_each_contact(
            blob, {blob, pose}, [&](const PairContact&) { ++work.pairs; }, unlimited);
    }
    if (is_refused(status)) throw std::runtime_error(std::string("a pose is refused: ") + describe(status));
    return work;
}

std::vector<Run> all_runs(const Subject& subject, PairQuestion question, PairWalk& walk) {
    std::vector<Run> runs;
    for (const PairRule rule : all_pair_rules)
        runs.push_back(
            {std::string(name_of(rule)),
             [&walk, rule, question](const Transform& pose) { return walk.run(rule, question, Placement(pose)); },
             true,
             true,
             {},
             {},
             {}});
    runs.push_back({"espalier",
                    [&subject, question](const Transform& pose) { return run_espalier(subject.blob, question, pose); },
                    question == PairQuestion::any,
                    false,
                    {},
                    {},
                    {}});
    return runs;
}

/// Makes one round, which all runs take part in.
void make_round(std::span<Run> runs, std::span<const Transform> poses) {
    for (Run& run : runs) {
        run.total = {};
        run.pairs.clear();
        const ProcessorTime time;
        for (const Transform& pose : poses) {
            const PairWork work = run.answer(pose);
            run.total.box_tests += work.box_tests;
            run.total.triangle_tests += work.triangle_tests;
            run.total.pairs += work.pairs;
            run.pairs.push_back(work.pairs);
        }
        run.nanoseconds.push_back(1e9 * time.seconds() / static_cast<double>(poses.size()));
    }
}

void check_answers(const std::string& mesh, std::span<const Run> runs) {
    for (const Run& run : runs)
        if (run.is_exact && run.pairs != runs.front().pairs)
            throw std::runtime_error(mesh + ": the rule " + run.rule + " has other answers than " + runs.front().rule);
}

std::size_t poses_that_differ(const Run& run, const Run& reference) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < run.pairs.size(); ++i) differing += run.pairs[i] != reference.pairs[i] ? 1u : 0u;
    return differing;
}

void print(const Subject& subject, const PoseClass& poses, PairQuestion question, const Run& run,
           const Run& reference) {
    const auto count = static_cast<double>(poses.poses.size());
    const auto mean = [&](std::uint64_t sum) -> std::optional<double> {
        if (!run.has_work) return std::nullopt;
        return static_cast<double>(sum) / count;
    };
    JsonObject row = guide_row("traversal pairs", subject.mesh.name, subject.built.tree.triangles.size());
    row.add("poses_are", std::string(poses.name));
    row.add("question", std::string(name_of(question)));
    row.add("rule", run.rule);
    row.add("poses", poses.poses.size());
    row.add("pairs", static_cast<double>(run.total.pairs) / count, 2);
    row.add("poses_that_differ", poses_that_differ(run, reference));
    row.add("box_tests", mean(run.total.box_tests), 1);
    row.add("triangle_tests", mean(run.total.triangle_tests), 1);
    add_spread(row, "ns", run.nanoseconds, 0);
    row.print();
}

}  // namespace

void measure_pairs(const Subject& subject, const TraversalOptions& options) {
    PairWalk walk(subject.built.tree, subject.built.tree);
    for (const PoseClass& poses : classes_of_poses(subject, options.poses)) {
        if (poses.poses.empty())
            throw std::runtime_error(subject.mesh.name + ": no pose is " + poses.name + "; add poses with --poses");
        for (const PairQuestion question : {PairQuestion::any, PairQuestion::all}) {
            std::vector<Run> runs = all_runs(subject, question, walk);
            for (std::size_t round = 0; round < options.rounds; ++round) make_round(runs, poses.poses);
            check_answers(subject.mesh.name, runs);
            for (const Run& run : runs) print(subject, poses, question, run, runs.front());
        }
        std::fflush(stdout);
    }
}

}  // namespace espalier::bench
