// A mesh against a second one of the same kind, in many poses: whether they touch, all pairs, how far they are apart.
// One JSON object a line for each mesh, system and question; what systems disagree about goes to stderr.

#include "../program.hpp"
#include "pair_system.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

struct Options {
    std::size_t poses = 200;
    unsigned repetitions = 5;
    std::vector<std::string> only;
};

std::vector<PairMaker> all_makers() {
    std::vector<PairMaker> makers = espalier_pair_makers();
    const auto append = [&](std::vector<PairMaker> more) {
        for (PairMaker& maker : more) makers.push_back(std::move(maker));
    };
    (void)append;
#ifdef ESPALIER_BENCH_FCL
    append(fcl_pair_makers());
#endif
#ifdef ESPALIER_BENCH_ODE
    append(ode_pair_makers());
#endif
    return makers;
}

/// What one system says of all poses, and the median of how long it takes.
struct Measured {
    std::vector<double> answers;
    double milliseconds = 0.0;
    double fastest = 0.0;
};

template <class Question>
Measured measure(const std::vector<Transform>& poses, unsigned repetitions, Question question) {
    Measured result;
    result.answers.resize(poses.size());
    std::vector<double> times;
    for (unsigned repetition = 0; repetition < repetitions; ++repetition) {
        const ProcessorTime time;
        for (std::size_t i = 0; i < poses.size(); ++i) result.answers[i] = static_cast<double>(question(poses[i]));
        times.push_back(1000.0 * time.seconds());
    }
    result.milliseconds = median_of(times);
    result.fastest = *std::min_element(times.begin(), times.end());
    return result;
}

void print(const Mesh& mesh, const PairMaker& maker, const char* question, const Measured& measured) {
    double sum = 0.0;
    for (const double answer : measured.answers) sum += answer;
    std::printf(
        "{\"mesh\":\"%s\",\"triangles\":%zu,\"system\":\"%s\",\"profile\":\"%s\",\"question\":\"%s\","
        "\"poses\":%zu,\"median_ms\":%.4f,\"fastest_ms\":%.4f,\"sum_of_answers\":%.9g}\n",
        mesh.name.c_str(), mesh.triangles.size(), maker.system.c_str(), maker.profile.c_str(), question,
        measured.answers.size(), measured.milliseconds, measured.fastest, sum);
    std::fflush(stdout);
}

void compare(const PairMaker& maker, const char* question, const Measured& measured, std::vector<double>& reference,
             double allowed) {
    if (reference.empty()) {
        reference = measured.answers;
        return;
    }
    std::size_t differing = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double difference = std::abs(reference[i] - measured.answers[i]);
        if (difference > allowed) ++differing;
        largest = std::max(largest, difference);
    }
    std::fprintf(stderr, "%s %s, %s: %zu of %zu poses differ from the first system, by at most %g\n",
                 maker.system.c_str(), maker.profile.c_str(), question, differing, reference.size(), largest);
}

void run_mesh(const std::string& file, const Options& options) {
    Mesh mesh = tests::read_mesh(file);
    bring_to_common_size(mesh);
    const auto searcher = espalier_pair_makers().front().make(mesh);
    const std::vector<Transform> poses =
        some_poses(mesh, options.poses, seed, [&](const Transform& pose) { return searcher->yes_no(pose); });
    std::vector<double> touching, distances;
    for (const PairMaker& maker : all_makers()) {
        if (!options.only.empty() &&
            std::find(options.only.begin(), options.only.end(), maker.system) == options.only.end())
            continue;
        const auto system = maker.make(mesh);
        if (system->has_yes_no()) {
            const Measured measured =
                measure(poses, options.repetitions, [&](const Transform& pose) { return system->yes_no(pose); });
            print(mesh, maker, "yes_no", measured);
            compare(maker, "yes_no", measured, touching, 0.0);
        }
        if (system->has_all())
            print(mesh, maker, "all",
                  measure(poses, options.repetitions, [&](const Transform& pose) { return system->all(pose); }));
        if (system->has_distance()) {
            const Measured measured =
                measure(poses, options.repetitions, [&](const Transform& pose) { return system->distance(pose); });
            print(mesh, maker, "distance", measured);
            compare(maker, "distance", measured, distances, 0.01);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_pairs",
                    "A mesh against a second one of its kind: whether they touch, all pairs, how far apart; JSON");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--repetitions", options.repetitions, "How often each system is asked; the median counts");
    program.add_choices("--only", options.only, {"espalier", "fcl", "ode"}, "Only this system; may be repeated");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& file : meshes) run_mesh(file, options);
    });
}

namespace espalier::bench {
namespace {

class EspalierPairs final : public PairSystem {
public:
    EspalierPairs(const Mesh& mesh, Profile profile) : made_(bake_blob(mesh, profile)) {}
    bool yes_no(const Transform& pose) override {
        const YesNo answer = overlaps(made_.blob, {made_.blob, pose}, unlimited);
        check(answer.status());
        return answer.yes();
    }
    std::size_t all(const Transform& pose) override {
        std::size_t count = 0;
        check(for_each_contact(
            made_.blob, {made_.blob, pose}, [&](const PairContact&) { ++count; }, unlimited));
        return count;
    }
    double distance(const Transform& pose) override {
        const BlobDistance nearest = espalier::distance(made_.blob, {made_.blob, pose}, unlimited);
        check(nearest.status);
        return static_cast<double>(nearest.distance);
    }

private:
    static void check(QueryStatus status) {
        if (status != QueryStatus::ok && status != QueryStatus::not_found) throw std::runtime_error(describe(status));
    }
    BakedBlob made_;
};

}  // namespace

std::vector<PairMaker> espalier_pair_makers() {
    std::vector<PairMaker> makers;
    const auto add = [&](const char* name, Profile profile) {
        makers.push_back(
            {"espalier", name, [profile](const Mesh& mesh) { return std::make_unique<EspalierPairs>(mesh, profile); }});
    };
    add("fast", Profile::fast);
    add("balanced", Profile::balanced);
    return makers;
}

}  // namespace espalier::bench
