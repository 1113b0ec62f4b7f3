// Espalier beside its peers, on the same vertices and the same rays, asked for the same outputs (t, u, v, normal, id).
// Systems take turns within every repetition, so that a change of the machine's speed hits them alike; a figure is the
// median of the repetitions' ratios, with the smallest and largest beside it.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <runtime/simd/select.hpp>

#include "../../tests/support/mesh_files.hpp"
#include "../rays.hpp"
#include "system.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Timing {
    std::vector<double> coherent, incoherent, any;
};

struct Spread {
    double low, median, high;
};
Spread spread(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {values.front(), values[values.size() / 2], values.back()};
}

std::vector<double> ratios(const std::vector<double>& reference, const std::vector<double>& own) {
    std::vector<double> result;
    for (std::size_t i = 0; i < own.size(); ++i) result.push_back(reference[i] / own[i]);
    return result;
}

double time_closest(System& system, const std::vector<Ray>& rays, bool coherent, std::vector<Hit>& hits) {
    const double start = seconds_now();
    system.closest(rays, coherent, hits);
    return seconds_now() - start;
}

double time_any(System& system, const std::vector<Ray>& rays, std::size_t& count) {
    const double start = seconds_now();
    count = system.any(rays);
    return seconds_now() - start;
}

struct Options {
    bool json = false;
    bool reference_only = false;  ///< no other peer than the one that ratios are taken to
    int repetitions = 9;
    std::size_t incoherent = 500000;
    unsigned bits = 16;
    unsigned effort = 5;
    std::vector<std::string> meshes;
};

Options parse(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--json") options.json = true;
        else if (word == "--reference-only") options.reference_only = true;
        else if (word == "--repetitions" && i + 1 < count) options.repetitions = std::atoi(words[++i]);
        else if (word == "--rays" && i + 1 < count)
            options.incoherent = static_cast<std::size_t>(std::atol(words[++i]));
        else if (word == "--bits" && i + 1 < count) options.bits = static_cast<unsigned>(std::atoi(words[++i]));
        else if (word == "--effort" && i + 1 < count) options.effort = static_cast<unsigned>(std::atoi(words[++i]));
        else if (word.rfind("--", 0) == 0) {
            std::fprintf(stderr,
                         "usage: espalier_bench_peers [--json] [--reference-only] [--repetitions N] [--rays N] [--bits "
                         "N] [--effort N] MESH...\n");
            std::exit(1);
        } else options.meshes.push_back(word);
    }
    return options;
}

const char* instruction_set_name() {
    switch (detail::instruction_set()) {
        case detail::InstructionSet::scalar:
            return "scalar";
        case detail::InstructionSet::sse42:
            return "sse4.2";
        case detail::InstructionSet::avx2:
            return "avx2";
        case detail::InstructionSet::neon:
            return "neon";
    }
    return "";
}

void measure(const std::string& path, const Options& options) {
    const Mesh mesh = tests::read_mesh(path);
    std::vector<std::unique_ptr<System>> systems =
        make_systems(mesh, options.bits, options.effort, options.reference_only);
    const std::vector<Ray> coherent = coherent_rays(mesh);
    const std::vector<Ray> incoherent = incoherent_rays(mesh, options.incoherent);
    std::vector<Timing> timings(systems.size());
    std::vector<std::vector<Hit>> hits(systems.size(), std::vector<Hit>(incoherent.size()));
    std::vector<Hit> view(coherent.size());
    std::vector<std::size_t> anys(systems.size());
    for (int repetition = 0; repetition < options.repetitions; ++repetition)
        for (std::size_t s = 0; s < systems.size(); ++s) {
            timings[s].coherent.push_back(time_closest(*systems[s], coherent, true, view));
            timings[s].incoherent.push_back(time_closest(*systems[s], incoherent, false, hits[s]));
            timings[s].any.push_back(time_any(*systems[s], incoherent, anys[s]));
        }
    for (std::size_t s = 0; s < systems.size(); ++s) {
        std::size_t disagreeing = 0;
        for (std::size_t i = 0; i < incoherent.size(); ++i) disagreeing += hits[s][i].found != hits[0][i].found;
        const Spread c = spread(ratios(timings[0].coherent, timings[s].coherent));
        const Spread n = spread(ratios(timings[0].incoherent, timings[s].incoherent));
        const Spread a = spread(ratios(timings[0].any, timings[s].any));
        const double bytes = static_cast<double>(systems[s]->bytes()) / static_cast<double>(mesh.triangles.size());
        const double build = systems[0]->build_seconds() / systems[s]->build_seconds();
        const double rate = static_cast<double>(incoherent.size()) / spread(timings[s].incoherent).median * 1e-6;
        if (options.json) {
            std::printf(
                "{\"system\":\"%s\",\"profile\":\"%s\",\"mesh\":\"%s\",\"triangles\":%zu,\"bits\":%u,\"effort\":%u,"
                "\"instruction_set\":\"%s\",\"bytes_per_triangle\":%.3f,"
                "\"incoherent_ratio\":%.3f,\"coherent_ratio\":%.3f,\"any_ratio\":%.3f,\"build_ratio\":%.3f,"
                "\"incoherent_spread\":[%.3f,%.3f],\"coherent_spread\":[%.3f,%.3f],\"any_spread\":[%.3f,%.3f],"
                "\"incoherent_mrays\":%.3f,\"disagreeing\":%zu}\n",
                systems[s]->name(), systems[s]->profile(), mesh.name.c_str(), mesh.triangles.size(), options.bits,
                options.effort, instruction_set_name(), bytes, n.median, c.median, a.median, build, n.low, n.high,
                c.low, c.high, a.low, a.high, rate, disagreeing);
        } else {
            std::printf(
                "%-12s %-16s %-12s %6.2f B/tri  incoherent %.2f (%.2f-%.2f)  coherent %.2f (%.2f-%.2f)  any %.2f "
                "(%.2f-%.2f)  build %.3f s  %.2f Mray/s  disagreeing %zu\n",
                mesh.name.c_str(), systems[s]->name(), systems[s]->profile(), bytes, n.median, n.low, n.high, c.median,
                c.low, c.high, a.median, a.low, a.high, systems[s]->build_seconds(), rate, disagreeing);
        }
        std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** words) {
    const Options options = parse(count, words);
    if (options.meshes.empty()) {
        std::fprintf(stderr, "espalier_bench_peers: name at least one mesh, .obj or .ply\n");
        return 1;
    }
    try {
        for (const std::string& path : options.meshes) measure(path, options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
