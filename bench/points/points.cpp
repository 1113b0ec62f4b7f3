// Spheres and closest points, beside Embree's point query: one thread, the systems take turns within each repetition,
// and a ratio is taken between neighbours in time. JSON, an object for each mesh and profile.

#include "../../tools/base/choices.hpp"
#include "../program.hpp"
#if defined(ESPALIER_BENCH_EMBREE)
#include "embree_points.hpp"
#endif

namespace {

using namespace espalier;
using namespace espalier::bench;

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

/// One way to answer one kind of question; gives something that depends on all answers.
struct Contestant {
    const char* name;
    std::function<double(const Questions&)> answer;
    std::vector<double> seconds = {};
    double sum = 0.0;
};

/// Adds up what `ask(point, radius)` returns.
template <class Ask>
Contestant sum_of(const char* name, const Ask& ask) {
    return {name, [ask](const Questions& q) {
                double sum = 0.0;
                for (const Vec3& p : q.points) sum += ask(p, q.radius);
                return sum;
            }};
}

void take_turns(std::span<Contestant> contestants, const Questions& questions, unsigned repetitions) {
    for (unsigned repetition = 0; repetition < repetitions; ++repetition)
        for (Contestant& contestant : contestants) {
            const Stopwatch watch;
            contestant.sum = contestant.answer(questions);
            contestant.seconds.push_back(watch.seconds());
        }
}

void print_kind(const char* kind, const Contestant* reference, const Contestant& own, std::size_t count) {
    std::printf(",\"%s_k\":%.1f", kind, static_cast<double>(count) / median_of(own.seconds) * 1e-3);
    if (reference == nullptr) return;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < own.seconds.size(); ++i) ratios.push_back(reference->seconds[i] / own.seconds[i]);
    std::printf(",\"%s_ratio\":%.3f,\"%s_low\":%.3f,\"%s_high\":%.3f,\"%s_sums\":[%.9g,%.9g]", kind, median_of(ratios),
                kind, *std::min_element(ratios.begin(), ratios.end()), kind,
                *std::max_element(ratios.begin(), ratios.end()), kind, reference->sum, own.sum);
}

void measure(const Mesh& mesh, const std::string& profile_name, Profile profile, const Options& options) {
    const BakedBlob made = bake_blob(mesh, profile);
    const Blob& blob = made.blob;
    const Questions questions = questions_about(mesh, options.points);

    std::vector<Contestant> all, any, closest;
#if defined(ESPALIER_BENCH_EMBREE)
    const EmbreePoints embree(mesh);
    const auto count_all = [&embree](const Vec3& p, float radius) {
        return static_cast<double>(embree.count_within(p, radius));
    };
    all.push_back(sum_of("embree", count_all));
    any.push_back(sum_of("embree", count_all));  // it has no any: its rate of all is what ours of any is held against
    closest.push_back(sum_of("embree", [&embree](const Vec3& p, float) { return double(embree.closest_distance(p)); }));
#endif
    all.push_back(sum_of("espalier", [&blob](const Vec3& p, float radius) {
        std::size_t count = 0;
        (void)for_each_overlap(blob, Sphere{p, radius}, [&count](TriangleId) { ++count; });
        return static_cast<double>(count);
    }));
    any.push_back(sum_of("espalier", [&blob](const Vec3& p, float radius) {
        return overlaps(blob, Sphere{p, radius}).yes() ? 1.0 : 0.0;
    }));
    closest.push_back(
        sum_of("espalier", [&blob](const Vec3& p, float) { return double(closest_point(blob, p).distance); }));
    std::printf("{\"mesh\":\"%s\",\"triangles\":%zu,\"profile\":\"%s\",\"points\":%zu,\"repetitions\":%u",
                mesh.name.c_str(), mesh.triangles.size(), profile_name.c_str(), options.points, options.repetitions);
    const auto kind = [&](const char* name, std::vector<Contestant>& contestants) {
        take_turns(contestants, questions, options.repetitions);
        print_kind(name, contestants.size() > 1 ? &contestants.front() : nullptr, contestants.back(), options.points);
    };
    kind("overlap_all", all);
    kind("overlap_any", any);
    kind("closest_point", closest);
    std::printf("}\n");
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_points", "Spheres and closest points, beside Embree's point query; JSON");
    program.add_count("--repetitions", options.repetitions, "How often each system answers all questions");
    program.add_count("--points", options.points, "Centres of spheres");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& path : meshes) {
            Mesh mesh = tests::read_mesh(path);
            bring_to_common_size(mesh);
            for (const auto& [name, profile] : tools::profile_choices) measure(mesh, name, profile, options);
        }
    });
}
