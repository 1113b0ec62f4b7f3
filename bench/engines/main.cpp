// engines: bodies that fall onto a level, with an engine's own mesh shape and with Espalier's: memory, time of a step,
// where they come to rest, and the energy that is left. Prints Markdown.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "drop.hpp"
#include "support/meshes/level_maker.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

std::vector<std::byte> baked(const tests::Mesh& mesh, Profile profile) {
    BakeOptions options;
    options.profile = profile;
    options.flat_angle = 3.0;
    const MeshView view = mesh.view();
    return bake(std::span(&view, 1), options).bytes;
}

void print(const char* engine, const char* shape, const Drop& drop, const Drop& own) {
    std::vector<double> apart;  // of bodies that are on the level in both
    for (std::size_t i = 0; i < drop.rest.size(); ++i) {
        const auto &p = drop.rest[i], &q = own.rest[i];
        if (p[2] > lost_below && q[2] > lost_below) apart.push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    std::sort(apart.begin(), apart.end());
    std::printf("| %s | %s | %zu | %.3f | %.2f | %u | %u | %.2f | %.2f |\n", engine, shape, drop.bytes,
                drop.ms_per_step, drop.ms_per_step / own.ms_per_step, drop.lost, drop.moving, drop.energy,
                apart.empty() ? 0.0 : apart[apart.size() / 2]);
}

}  // namespace

int main() {
    const tests::Mesh mesh = tests::make_level(20'000, 3);
    const std::vector<std::byte> fast = baked(mesh, Profile::fast), balanced = baked(mesh, Profile::balanced),
                                 small = baked(mesh, Profile::small);
    std::printf(
        "| engine | mesh shape | bytes | ms a step | times its own | fallen off | still moving | energy of motion, J | "
        "median distance between resting places, m |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const Engine& engine : engines()) {
        // In turns, of which the fastest counts: the first warms the caches.
        Drop own, ours[3];
        for (int turn = 0; turn < 3; ++turn) {
            const auto keep = [&](Drop& best, const Drop& drop) {
                if (turn == 0 || drop.ms_per_step < best.ms_per_step) best = drop;
            };
            keep(own, engine.drop(mesh, {}));
            const std::vector<std::byte>* blobs[] = {&fast, &balanced, &small};
            for (int i = 0; i < 3; ++i) keep(ours[i], engine.drop(mesh, open(*blobs[i])));
        }
        print(engine.name, "its own", own, own);
        const char* names[] = {"`fast`", "`balanced`", "`small`"};
        for (int i = 0; i < 3; ++i) print(engine.name, names[i], ours[i], own);
    }
    return 0;
}
