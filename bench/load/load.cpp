// From bytes on disk to the first ray's answer: floats, meshoptimizer's streams and blobs, each loaded in several ways,
// which take turns. A JSON object a line.

#include "../program.hpp"
#include "ways.hpp"

namespace espalier::bench {
namespace {

struct Options {
    std::size_t rays = 20'000;  ///< that are compared with the reference
    std::size_t rounds = 5;
};

struct Measured {
    Way way;
    std::optional<Bytes> deflated;
    std::optional<std::size_t> peak;
    std::size_t memory = 0;
    std::size_t differing = 0;
    std::vector<double> load_ms = {};
    std::vector<double> inflate_ms = {};
};

double milliseconds(const Stopwatch& watch) { return 1000.0 * watch.seconds(); }

/// Loads, and answers one ray. Returns what was loaded.
std::unique_ptr<Loaded> load_and_answer(const Way& way, const Ray& ray) {
    std::unique_ptr<Loaded> loaded = way.load(way.file);
    static_cast<void>(loaded->closest(ray));
    return loaded;
}

/// Before anything else, since a child process has none of the threads of its parent.
void measure_peaks(std::vector<Measured>& all, const Ray& ray) {
    for (Measured& measured : all) {
        measured.peak = peak_memory([&] { static_cast<void>(load_and_answer(measured.way, ray)); });
        // The bytes that are loaded from stay until the load ends.
        if (measured.peak && !measured.way.is_mapped) *measured.peak += measured.way.file.size();
    }
}

void measure_round(std::vector<Measured>& all, const Ray& ray) {
    for (Measured& measured : all) {
        const Stopwatch watch;
        const std::unique_ptr<Loaded> loaded = load_and_answer(measured.way, ray);
        measured.load_ms.push_back(milliseconds(watch));
    }
    for (Measured& measured : all) {
        if (!measured.deflated) continue;
        const Stopwatch watch;
        const Bytes file = inflate_bytes(*measured.deflated, measured.way.file.size());
        measured.inflate_ms.push_back(milliseconds(watch));
    }
}

/// Counts rays that hit in one and miss in the other.
void compare_answers(std::vector<Measured>& all, const std::vector<Ray>& rays) {
    std::vector<bool> reference;
    for (Measured& measured : all) {
        const std::unique_ptr<Loaded> loaded = load_and_answer(measured.way, rays.front());
        measured.memory = loaded->bytes();
        std::vector<bool> hits;
        for (const Ray& ray : rays) hits.push_back(!std::isinf(loaded->closest(ray)));
        if (reference.empty()) reference = hits;
        for (std::size_t i = 0; i < rays.size(); ++i) measured.differing += hits[i] != reference[i];
    }
}

void print(const Mesh& mesh, const Measured& measured, const Options& options) {
    JsonObject row = guide_row("load", mesh.name, mesh.triangles.size());
    row.add("ships", measured.way.ships);
    row.add("loads", measured.way.loads);
    row.add("file_bytes", measured.way.file.size());
    row.add("deflated_bytes", measured.deflated ? std::optional(measured.deflated->size()) : std::nullopt);
    row.add("memory_bytes", measured.memory);
    row.add("peak_bytes", measured.peak);
    add_spread(row, "load_ms", measured.load_ms, 4);
    row.add("inflate_ms", measured.deflated ? std::optional(median_of(measured.inflate_ms)) : std::nullopt, 4);
    row.add("rays", options.rays);
    row.add("rays_differ", measured.differing);
    row.add("rounds", options.rounds);
    row.print();
}

void measure_mesh(const Mesh& mesh, const Options& options) {
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    std::vector<Measured> all;
    for (Way& way : all_ways(mesh)) {
        std::optional<Bytes> deflated = deflate_bytes(way.file);
        all.push_back({std::move(way), std::move(deflated), std::nullopt});
    }
    measure_peaks(all, rays.front());
    for (std::size_t round = 0; round < options.rounds; ++round) measure_round(all, rays[round % rays.size()]);
    compare_answers(all, rays);
    for (const Measured& measured : all) print(mesh, measured, options);
    std::fflush(stdout);
}

}  // namespace

const Subcommand subcommand("load", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_study load", "Bytes on disk, memory, and time until the first ray's answer; JSON");
    program.add_count("--rays", options.rays, "Rays that are compared with the reference");
    program.add_count("--rounds", options.rounds, "Rounds in which the ways take turns");
    return program.run(count, words, [&](const std::vector<std::string>& files) {
        for (const std::string& file : files) measure_mesh(tests::read_mesh(file), options);
    });
});

}  // namespace espalier::bench
