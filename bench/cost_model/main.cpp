// What a ray costs on this machine: T = Nv Cv + Np Cp + Nu Cu + Co (Gottschalk, Lin, Manocha 1996; van den Bergen
// 1997), with the visited nodes Nv and the tested triangles Np counted and the costs fitted to measured times. Nu, the
// boxes that are updated or transformed, is 0 until blobs are tested against each other.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "../../tests/support/mesh_files.hpp"
#include "../rays.hpp"
#include "least_squares.hpp"
#include "ray_groups.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

constexpr std::pair<const char*, format::Profile> profiles[] = {{"fast", format::Profile::fast}};
/// Leaves of several sizes in one fit: else nodes and triangles grow together, and their costs cannot be told apart.
constexpr unsigned leaf_sizes[] = {4, 8, 16};
constexpr std::uint64_t seed = 2026;

constexpr const char* usage =
    "usage: espalier_bench_cost_model [OPTION...] MESH.obj|MESH.ply...\n"
    "  --json              a JSON object for each row instead of text\n"
    "  --rays N            incoherent rays (200000)\n"
    "  --repetitions N     how often each group of rays is cast (7)\n"
    "  --bits N            lattice bits (16)\n"
    "  --effort N          0 to 9 (5)\n";

struct Options {
    bool json = false;
    unsigned rays = 200'000;
    unsigned repetitions = 7;
    BakeOptions bake;
    std::vector<std::string> meshes;
};

Options parse(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto number = [&](long low, long high) {
            char* end = nullptr;
            const long value = i + 1 < count ? std::strtol(words[++i], &end, 10) : low - 1;
            if (value < low || value > high || (end != nullptr && *end != 0))
                throw std::invalid_argument(word + " takes a whole number from " + std::to_string(low) + " to " +
                                            std::to_string(high));
            return static_cast<unsigned>(value);
        };
        if (word == "--json") options.json = true;
        else if (word == "--rays") options.rays = number(1000, 100'000'000);
        else if (word == "--repetitions") options.repetitions = number(1, 1000);
        else if (word == "--bits") options.bake.bits = number(1, 24);
        else if (word == "--effort") options.bake.effort = number(0, 9);
        else if (word.starts_with("-")) throw std::invalid_argument("there is no option '" + word + "'");
        else options.meshes.push_back(word);
    }
    if (options.meshes.empty()) throw std::invalid_argument("name at least one mesh, .obj or .ply");
    return options;
}

/// What was measured, with triangles one by one (the classic Np) and by the groups of 8 that lanes test at once.
struct Measurements {
    std::vector<Observation> by_triangles;
    std::vector<Observation> by_groups;
};

Measurements measure(const Mesh& mesh, const Options& options, format::Profile profile) {
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    const MeshView view = mesh.view();
    Measurements result;
    for (const unsigned leaf_size : leaf_sizes) {
        BakeOptions bake_options = options.bake;
        bake_options.profile = profile;
        bake_options.max_leaf_triangles = leaf_size;
        const auto baked = bake({&view, 1}, bake_options);
        if (!baked) throw std::runtime_error(mesh.name + ": " + baked.error().message);
        Blob blob;
        if (const Status status = open(baked->blob, blob); status != Status::ok)
            throw std::runtime_error(mesh.name + ": " + describe(status));
        std::vector<RayGroup> groups = group_by_work(blob, rays);
        time_groups(blob, groups, options.repetitions);
        for (const RayGroup& group : groups) {
            result.by_triangles.push_back({{group.nodes, group.triangles, 1.0}, group.nanoseconds});
            result.by_groups.push_back({{group.nodes, group.groups, 1.0}, group.nanoseconds});
        }
    }
    return result;
}

char sign(double value) { return value < 0.0 ? '-' : '+'; }

void print_text(const std::string& mesh, const char* profile, const Fit& triangles, const Fit& groups) {
    const auto [cv, cp, co] = triangles.coefficients;
    std::printf("%s, %s: T = Nv * %.2f + Np * %.3f + Nu * 0 %c %.1f ns\n", mesh.c_str(), profile, cv, cp, sign(co),
                std::abs(co));
    std::printf("  residual %.1f ns of %.1f ns a ray, %.1f %% of the variance explained\n", triangles.residual,
                triangles.mean, 100.0 * triangles.explained);
    const auto [gv, gp, go] = groups.coefficients;
    std::printf("  by groups of 8 triangles: T = Nv * %.2f + Ng * %.2f %c %.1f ns, residual %.1f ns\n", gv, gp,
                sign(go), std::abs(go), groups.residual);
    if (gv > 0.0 && gp >= 0.0)
        std::printf("  for --cost-model: {\"node_visit\": 1, \"leaf_visit\": %.3f, \"triangle\": 0}\n", gp / gv);
    else std::printf("  no cost model: a cost came out negative; measure on a quiet machine, with more rays\n");
}

void print_json(const std::string& mesh, const char* profile, const Fit& triangles, const Fit& groups) {
    const auto [cv, cp, co] = triangles.coefficients;
    std::printf(
        "{\"mesh\":\"%s\",\"profile\":\"%s\",\"node_ns\":%.4f,\"triangle_ns\":%.4f,\"update_ns\":0,\"constant_ns\":%."
        "4f,"
        "\"residual_ns\":%.4f,\"mean_ns\":%.4f,\"explained\":%.5f,\"by_groups\":{\"node_ns\":%.4f,\"group_ns\":%.4f,"
        "\"constant_ns\":%.4f,\"residual_ns\":%.4f}}\n",
        mesh.c_str(), profile, cv, cp, co, triangles.residual, triangles.mean, triangles.explained,
        groups.coefficients[0], groups.coefficients[1], groups.coefficients[2], groups.residual);
}

void run(const Options& options) {
    if (!options.json)
        std::printf(
            "Nv: nodes visited, Np: triangles tested, both counted by the scalar path; Nu: updates of boxes, 0\n"
            "until two blobs are tested against each other. Costs in nanoseconds, fitted to incoherent rays.\n");
    for (const std::string& path : options.meshes) {
        const Mesh mesh = tests::read_mesh(path);
        for (const auto& [name, profile] : profiles) {
            const Measurements measurements = measure(mesh, options, profile);
            const auto triangles = fit(measurements.by_triangles), groups = fit(measurements.by_groups);
            if (!triangles || !groups)
                throw std::runtime_error(mesh.name + ": all rays do the same work, so that nothing can be fitted");
            (options.json ? print_json : print_text)(mesh.name, name, *triangles, *groups);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    try {
        run(parse(count, words));
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "espalier_bench_cost_model: %s\n%s", error.what(), usage);
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "espalier_bench_cost_model: %s\n", error.what());
        return 2;
    }
    return 0;
}
