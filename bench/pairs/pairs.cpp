// A mesh against a second one of the same kind, in many poses: whether they touch, all pairs, how far they are apart.
// One JSON object a line for each mesh, system and question; what systems disagree about goes to stderr.

#include "pairs.hpp"

#include "../../tools/base/choices.hpp"
#include "../program.hpp"

namespace espalier::bench {
namespace {

struct Options {
    std::size_t poses = 200;
    unsigned repetitions = 5;
    std::vector<std::string> only;
};

void check(QueryStatus status) {
    if (status != QueryStatus::ok && status != QueryStatus::not_found) throw std::runtime_error(describe(status));
}

void add_espalier_pairs(const Mesh& mesh, PairContests& to) {
    for (const Profile profile : {Profile::fast, Profile::balanced}) {
        const std::string& name = tools::name_in(tools::profile_choices, profile);
        const auto made = std::make_shared<BakedBlob>(bake_blob(mesh, profile));
        to.yes_no.push_back({"espalier", name, one_by_one([made](const Transform& pose) {
                                 const YesNo answer = overlaps(made->blob, {made->blob, pose}, unlimited);
                                 check(answer.status());
                                 return answer.yes();
                             })});
        to.all.push_back(
            {"espalier", name, one_by_one([made](const Transform& pose) { return count_contacts(made->blob, pose); })});
        to.distance.push_back({"espalier", name, one_by_one([made](const Transform& pose) {
                                   const BlobDistance nearest = distance(made->blob, {made->blob, pose}, unlimited);
                                   check(nearest.status);
                                   return nearest.distance;
                               })});
    }
}

PairContests contests_of(const Mesh& mesh, const std::vector<std::string>& only) {
    const auto is_asked_for = [&](const char* system) {
        return only.empty() || std::find(only.begin(), only.end(), system) != only.end();
    };
    PairContests contests;
    if (is_asked_for("espalier")) add_espalier_pairs(mesh, contests);
#ifdef ESPALIER_BENCH_FCL
    if (is_asked_for("fcl")) add_fcl_pairs(mesh, contests);
#endif
#ifdef ESPALIER_BENCH_ODE
    if (is_asked_for("ode")) add_ode_pairs(mesh, contests);
#endif
    return contests;
}

/// Prints a row for each system. Of answers that are off by more than `allowed`, the number goes to stderr.
void measure(const Mesh& mesh, const char* question, PoseContest& contest, const std::vector<Transform>& poses,
             unsigned repetitions, std::optional<double> allowed) {
    for (auto& contestant : contest) {
        for (unsigned repetition = 0; repetition < repetitions; ++repetition) contestant.answer(poses);
        JsonObject row;
        row.add("mesh", mesh.name);
        row.add("triangles", mesh.triangles.size());
        add_machine(row);
        row.add("system", contestant.system);
        row.add("profile", contestant.profile);
        row.add("question", question);
        row.add("poses", poses.size());
        row.add("median_ms", 1e3 * median_of(contestant.seconds), 4);
        row.add("fastest_ms", 1e3 * contestant.least_seconds(), 4);
        row.add_raw("sum_of_answers", digits_of(contestant.sum_of_answers(), 9));
        row.print();
        std::fflush(stdout);
        if (!allowed || &contestant == &contest.front()) continue;
        std::size_t differing = 0;
        double largest = 0.0;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const double difference = std::abs(contest.front().answers[i] - contestant.answers[i]);
            differing += difference > *allowed ? 1u : 0u;
            largest = std::max(largest, difference);
        }
        std::fprintf(stderr, "%s %s, %s: %zu of %zu poses differ from the first system, by at most %g\n",
                     contestant.system.c_str(), contestant.profile.c_str(), question, differing, poses.size(), largest);
    }
}

void measure(const Mesh& mesh, const Options& options) {
    const BakedBlob searcher = bake_blob(mesh, Profile::fast);
    const std::vector<Transform> poses = some_poses(mesh, options.poses, seed, [&](const Transform& pose) {
        return overlaps(searcher.blob, {searcher.blob, pose}, unlimited).yes();
    });
    PairContests contests = contests_of(mesh, options.only);
    measure(mesh, "yes_no", contests.yes_no, poses, options.repetitions, 0.0);
    measure(mesh, "all", contests.all, poses, options.repetitions, std::nullopt);
    measure(mesh, "distance", contests.distance, poses, options.repetitions, 0.01);
}

}  // namespace

const Subcommand subcommand("pairs", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_peers pairs",
                    "A mesh against a second one of its kind: whether they touch, all pairs, how far apart; JSON");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--repetitions", options.repetitions, "How often each system is asked; the median counts");
    program.add_words("--only", options.only, "Only this system; may be repeated", {"espalier", "fcl", "ode"});
    return program.run_at_common_size(count, words, [&](const Mesh& mesh) { measure(mesh, options); });
});

}  // namespace espalier::bench
