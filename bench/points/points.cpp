// Spheres and closest points, beside Embree's point query. JSON, an object for each mesh and profile.

#include "points.hpp"

#include "../../tools/base/choices.hpp"
#include "../peers/contest.hpp"
#include "../program.hpp"

namespace espalier::bench {
namespace {

struct Options {
    unsigned repetitions = 5;
    std::size_t points = 20000;
};

/// Centres anywhere in the box; the radius is 2 % of its diagonal.
struct Questions {
    std::vector<Vec3> points;
    float radius = 0.0f;
};

Questions questions_about(const Mesh& mesh, std::size_t count) {
    const auto [low, high] = box_around(mesh.positions);
    const Vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    Questions questions;
    questions.radius = 0.02f * std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
    tests::Random random(seed);
    for (std::size_t i = 0; i < count; ++i)
        questions.points.push_back(
            {low.x + size.x * random.unit(), low.y + size.y * random.unit(), low.z + size.z * random.unit()});
    return questions;
}

/// Embree is the first, if it is there, and Espalier the last.
using PointContest = Contest<Vec3, double>;

void add_kind(JsonObject& row, const std::string& kind, const PointContest& contest) {
    const auto &reference = contest.front(), &own = contest.back();
    row.add(kind + "_k", static_cast<double>(own.answers.size()) / median_of(own.seconds) * 1e-3, 1);
    if (contest.size() == 1) return;
    const Spread ratios = ratio(reference.seconds, own.seconds);
    row.add(kind + "_ratio", ratios.median, 3);
    row.add(kind + "_low", ratios.low, 3);
    row.add(kind + "_high", ratios.high, 3);
    row.add_raw(kind + "_sums",
                json_list({digits_of(reference.sum_of_answers(), 9), digits_of(own.sum_of_answers(), 9)}));
}

void measure(const Mesh& mesh, const std::string& profile_name, Profile profile, const Options& options) {
    const BakedBlob made = bake_blob(mesh, profile);
    const Blob& blob = made.blob;
    const Questions questions = questions_about(mesh, options.points);
    const float radius = questions.radius;

    PointContest all, any, closest;
#if defined(ESPALIER_BENCH_EMBREE)
    const EmbreePoints embree = embree_points(mesh);
    all.push_back({"embree", "", one_by_one([&](const Vec3& p) { return embree.count_within(p, radius); })});
    any = all;  // it has no any: its rate of all is what ours of any is held against
    closest.push_back({"embree", "", one_by_one(embree.closest_distance)});
#endif
    all.push_back({"espalier", profile_name, one_by_one([&](const Vec3& p) {
                       std::size_t count = 0;
                       (void)for_each_overlap(blob, Sphere{p, radius}, [&count](TriangleId) { ++count; });
                       return count;
                   })});
    any.push_back({"espalier", profile_name, one_by_one([&](const Vec3& p) {
                       return overlaps(blob, Sphere{p, radius}).yes();
                   })});
    closest.push_back(
        {"espalier", profile_name, one_by_one([&](const Vec3& p) { return closest_point(blob, p).distance; })});
    JsonObject row;
    row.add("mesh", mesh.name);
    row.add("triangles", mesh.triangles.size());
    add_machine(row);
    row.add("profile", profile_name);
    row.add("points", options.points);
    row.add("repetitions", std::size_t{options.repetitions});
    const auto add = [&](const std::string& kind, PointContest& contest) {
        take_turns(contest, std::span<const Vec3>(questions.points), options.repetitions);
        add_kind(row, kind, contest);
    };
    add("overlap_all", all);
    add("overlap_any", any);
    add("closest_point", closest);
    row.print();
}

}  // namespace

const Subcommand subcommand("points", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_peers points", "Spheres and closest points, beside Embree's point query; JSON");
    program.add_count("--repetitions", options.repetitions, "How often each system answers all questions");
    program.add_count("--points", options.points, "Centres of spheres");
    return program.run_at_common_size(count, words, [&](const Mesh& mesh) {
        for (const auto& [name, profile] : tools::profile_choices) measure(mesh, name, profile, options);
    });
});

}  // namespace espalier::bench
