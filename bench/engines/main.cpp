// engines: bodies that fall onto levels, with an engine's own mesh shape and with Espalier's: memory, time of a step,
// where they come to rest, and the energy that is left. JSON, an object a line.
#include <iterator>

#include "drop.hpp"
#include "support/meshes/level_maker.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

/// Bodies are chaotic: the work on one level depends on where a few of them come to rest.
constexpr std::uint32_t level_count = 10, first_seed = 3;
constexpr const char* shape_names[] = {"its own", "fast", "balanced", "small"};
constexpr std::size_t shape_count = std::size(shape_names);

std::vector<std::byte> baked(const tests::Mesh& mesh, Profile profile) {
    return bake_blob(mesh, BakeOptions{.profile = profile, .flat_angle = 3.0}).baked.bytes;
}

/// What bodies did on all levels.
struct Total {
    std::size_t bytes = 0;
    double ms_per_step = 0.0;
    unsigned lost = 0, moving = 0;
    double energy = 0.0;
    std::vector<double>
        apart;  ///< from the resting places on the engine's own shape, of bodies that are on both levels

    void add(const Drop& drop, const Drop& own) {
        bytes += drop.bytes;
        ms_per_step += drop.ms_per_step;
        lost += drop.lost;
        moving += drop.moving;
        energy += drop.energy;
        for (std::size_t i = 0; i < drop.rest.size(); ++i) {
            const auto &p = drop.rest[i], &q = own.rest[i];
            if (p[2] > lost_below && q[2] > lost_below)
                apart.push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
    }
};

void print(const char* engine, const char* shape, Total& total, const Total& own) {
    std::sort(total.apart.begin(), total.apart.end());
    JsonObject row;
    row.add("engine", engine);
    row.add("shape", shape);
    add_machine(row);
    row.add("levels", std::size_t{level_count});
    row.add("bytes", total.bytes / level_count);
    row.add("ms_per_step", total.ms_per_step / level_count, 3);
    row.add("times_own", total.ms_per_step / own.ms_per_step, 2);
    row.add("fallen", std::size_t{total.lost});
    row.add("moving", std::size_t{total.moving});
    row.add("energy", total.energy, 2);
    row.add("metres_apart", total.apart.empty() ? 0.0 : total.apart[total.apart.size() / 2], 2);
    row.print();
}

/// Adds the drops onto one level, on the engine's own shape and on each blob.
void drop_on(std::uint32_t seed, const Engine& engine, Total (&totals)[shape_count]) {
    const tests::Mesh mesh = tests::make_level(20'000, seed);
    const std::vector<std::byte> blobs[] = {baked(mesh, Profile::fast), baked(mesh, Profile::balanced),
                                            baked(mesh, Profile::small)};
    // In turns, of which the fastest counts: the first warms the caches.
    Drop drops[shape_count];
    for (int turn = 0; turn < 3; ++turn) {
        for (std::size_t i = 0; i < shape_count; ++i) {
            const Drop drop = engine.drop(mesh, i == 0 ? Blob() : open(blobs[i - 1]));
            if (turn == 0 || drop.ms_per_step < drops[i].ms_per_step) drops[i] = drop;
        }
    }
    for (std::size_t i = 0; i < shape_count; ++i) totals[i].add(drops[i], drops[0]);
}

}  // namespace

int main() {
    for (const Engine& engine : engines()) {
        Total totals[shape_count];
        for (std::uint32_t level = 0; level < level_count; ++level) drop_on(first_seed + level, engine, totals);
        for (std::size_t i = 0; i < shape_count; ++i) print(engine.name, shape_names[i], totals[i], totals[0]);
    }
    return 0;
}
