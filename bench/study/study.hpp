// The harness of the study's parts: what measures a way to answer queries, and which poses two meshes are in.
#pragma once

#include "../program.hpp"
#include "walks.hpp"

namespace espalier::bench {

/// The answers of one way to answer queries, and what they took.
template <class Answer, class Work>
struct Timed {
    Work work = {};  ///< of all queries, in the last round
    std::vector<Answer> answers = {};
    std::vector<double> nanoseconds = {};  ///< of a query, in each round

    /// Asks all queries once more: `ask(query, work)` answers one and adds its work.
    template <class Queries, class Ask>
    void make_round(const Queries& queries, const Ask& ask) {
        work = {};
        answers.clear();
        answers.reserve(queries.size());
        const ProcessorTime time;
        for (const auto& query : queries) answers.push_back(ask(query, work));
        nanoseconds.push_back(1e9 * time.seconds() / static_cast<double>(queries.size()));
    }
    /// Returns how many answers are others than those of the reference.
    [[nodiscard]] std::size_t differing(const Timed& reference) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < answers.size(); ++i) count += answers[i] != reference.answers[i] ? 1u : 0u;
        return count;
    }
    [[nodiscard]] double mean(std::uint64_t sum) const { return per(sum, answers.size()); }
};

/// A named way to answer queries, called through a pointer.
template <class Query, class Answer, class Work>
struct Run {
    std::string name;
    std::function<Answer(const Query& query, Work& work)> ask;
    bool is_exact = true;  ///< it must have the answers of the other such runs
    Timed<Answer, Work> timed = {};
};

/// All runs answer all queries, in turns. Throws std::runtime_error, which begins with `subject`, if two that must have
/// the same answers do not.
template <class Query, class Answer, class Work>
void take_turns(const std::string& subject, std::vector<Run<Query, Answer, Work>>& runs,
                const std::vector<Query>& queries, std::size_t rounds) {
    for (std::size_t round = 0; round < rounds; ++round)
        for (auto& run : runs) run.timed.make_round(queries, run.ask);
    for (const auto& run : runs)
        if (run.is_exact && run.timed.answers != runs.front().timed.answers)
            throw std::runtime_error(subject + ": " + run.name + " has other answers than " + runs.front().name);
}

/// Pairs of triangles that touch, of two meshes in a pose.
using PairRun = Run<Transform, std::uint64_t, PairWork>;

/// Returns what a PairRun asks: `walk(pose)` returns the work of a pose.
template <class Walk>
auto pairs_by(const Walk& walk) {
    return [walk](const Transform& pose, PairWork& total) {
        const PairWork work = walk(pose);
        total += work;
        return work.pairs;
    };
}

struct PoseClass {
    std::string name;
    std::vector<Transform> poses;
};
/// Returns poses of a second mesh of the same kind in which the two are apart, and in which they touch. Throws
/// std::runtime_error if there are none.
inline std::vector<PoseClass> classes_of_poses(const TreeSubject& subject, std::size_t count) {
    const auto touches = [&](const Transform& pose) {
        return overlaps(subject.blob(), {subject.blob(), pose}, unlimited).yes();
    };
    std::vector<PoseClass> classes = {{"apart", {}}, {"touching", {}}};
    for (const Transform& pose : some_poses(subject.mesh, count, seed, touches))
        classes[touches(pose) ? 1 : 0].poses.push_back(pose);
    for (const PoseClass& poses : classes)
        if (poses.poses.empty())
            throw std::runtime_error(subject.mesh.name + ": no pose is " + poses.name + "; add poses with --poses");
    return classes;
}

inline std::size_t count_finite(std::span<const double> values) {
    return static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](double t) { return std::isfinite(t); }));
}

}  // namespace espalier::bench
