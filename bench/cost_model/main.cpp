// What a ray costs on this machine: T = Nv Cv + Np Cp + Nu Cu + Co (Gottschalk, Lin, Manocha 1996; van den Bergen
// 1997), with the visited nodes Nv and the tested triangles Np counted and the costs fitted to measured times. Nu, the
// boxes that are updated or transformed, is 0 until blobs are tested against each other.
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "../../tests/support/meshes/files.hpp"
#include "../program.hpp"
#include "../rays.hpp"
#include "least_squares.hpp"
#include "ray_groups.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

struct ProfileRun {
    const char* name;
    Profile profile;
    unsigned largest_leaf;
};
constexpr ProfileRun profiles[] = {{"fast", Profile::fast, format::plain_leaf::max_triangles},
                                   {"balanced", Profile::balanced, format::strip_leaf::max_balanced_entries - 2},
                                   {"small", Profile::small, format::strip_leaf::max_small_entries - 2},
                                   {"tiny", Profile::tiny, format::predicted_strip::max_entries - 2}};
/// Leaves of several sizes in one fit: else nodes and triangles grow together, and their costs cannot be told apart.
constexpr unsigned leaf_divisors[] = {4, 2, 1};
constexpr std::uint64_t seed = 2026;

struct Options {
    bool json = false;
    unsigned rays = 200'000;
    unsigned repetitions = 7;
    unsigned bits = 16;
};

/// What stands for the tested triangles: themselves (the classic Np), the groups of 8 of a leaf that lanes test at
/// once, or the leaves they lie in.
struct Term {
    const char* symbol;
    const char* name;
    double RayGroup::*count;
};
constexpr Term terms[] = {{"Np", "triangle", &RayGroup::triangles},
                          {"Ng", "group of 8 triangles", &RayGroup::groups},
                          {"Nl", "leaf", &RayGroup::leaves}};
using Fits = std::array<Fit, std::size(terms)>;

Fits measure(const Mesh& mesh, const Options& options, const ProfileRun& profile) {
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    const MeshView view = mesh.view();
    std::vector<BakeResult> blobs;  // the groups' blobs point into them
    std::vector<RayGroup> groups;
    for (const unsigned divisor : leaf_divisors) {
        BakeOptions bake_options;
        bake_options.resolution = Resolution::bits(options.bits);
        bake_options.profile = profile.profile;
        bake_options.build.max_leaf_triangles = profile.largest_leaf / divisor;
        auto baked = bake({&view, 1}, bake_options);
        if (!baked) throw std::runtime_error(mesh.name + ": " + baked.message);
        blobs.push_back(std::move(baked));
        const Blob blob = open(blobs.back().bytes);
        if (!blob) throw std::runtime_error(mesh.name + ": " + describe(blob.status()));
        for (RayGroup& group : group_by_work(blob, rays)) groups.push_back(std::move(group));
    }
    time_groups(groups, options.repetitions);
    Fits fits;
    for (std::size_t i = 0; i < std::size(terms); ++i) {
        std::vector<Observation> observations;
        for (const RayGroup& group : groups)
            observations.push_back({{group.nodes, group.*terms[i].count, 1.0}, group.nanoseconds});
        const auto fitted = fit(observations);
        if (!fitted) throw std::runtime_error(mesh.name + ": all rays do the same work, so that nothing can be fitted");
        fits[i] = *fitted;
    }
    return fits;
}

char sign(double value) { return value < 0.0 ? '-' : '+'; }

void print_text(const std::string& mesh, const char* profile, const Fits& fits) {
    std::printf("%s, %s:\n", mesh.c_str(), profile);
    for (std::size_t i = 0; i < std::size(terms); ++i) {
        const auto [node, other, constant] = fits[i].coefficients;
        std::printf(
            "  T = Nv * %.2f + %s * %.2f + Nu * 0 %c %.1f ns, residual %.1f of %.1f ns a ray, %.1f %% explained\n",
            node, terms[i].symbol, other, sign(constant), std::abs(constant), fits[i].residual, fits[i].mean,
            100.0 * fits[i].explained);
    }
    const auto [node, group, constant] = fits[1].coefficients;
    if (node > 0.0 && group >= 0.0)
        std::printf("  RayCosts of collapse.hpp: node_visit 1, leaf_visit 0, leaf_group %.3f\n", group / node);
    else std::printf("  no cost model: a cost came out negative; measure on a quiet machine, with more rays\n");
}

void print_json(const std::string& mesh, const char* profile, const Fits& fits) {
    std::printf("{\"mesh\":\"%s\",\"profile\":\"%s\",\"mean_ns\":%.4f,\"update_ns\":0,\"fits\":[", mesh.c_str(),
                profile, fits[0].mean);
    for (std::size_t i = 0; i < std::size(terms); ++i) {
        const auto [node, other, constant] = fits[i].coefficients;
        std::printf(
            "%s{\"term\":\"%s\",\"node_ns\":%.4f,\"term_ns\":%.4f,\"constant_ns\":%.4f,\"residual_ns\":%.4f,"
            "\"explained\":%.5f}",
            i == 0 ? "" : ",", terms[i].name, node, other, constant, fits[i].residual, fits[i].explained);
    }
    std::printf("]}\n");
}

void run(const std::vector<std::string>& meshes, const Options& options) {
    if (!options.json)
        std::printf(
            "Nv: nodes visited; Np: triangles tested; Ng: groups of 8 of them in a leaf; Nl: leaves visited; all\n"
            "counted by the scalar path. Nu: updates of boxes, 0 until two blobs are tested against each other.\n");
    for (const std::string& path : meshes) {
        const Mesh mesh = tests::read_mesh(path);
        for (const ProfileRun& profile : profiles) {
            const Fits fits = measure(mesh, options, profile);
            (options.json ? print_json : print_text)(mesh.name, profile.name, fits);
            std::fflush(stdout);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_cost_model", "What a ray costs on this machine, fitted to measured times");
    program.add_flag("--json", options.json, "A JSON object for each row instead of text");
    program.add_number("--rays", options.rays, 1000u, 100'000'000u, "Incoherent rays");
    program.add_count("--repetitions", options.repetitions, "How often each group of rays is cast");
    program.add_number("--bits", options.bits, 1u, 24u, "Lattice bits");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) { run(meshes, options); });
}
