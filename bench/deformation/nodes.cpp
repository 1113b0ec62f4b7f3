// What a refit is made of: nodes, whose boxes are updated (Nu of the cost model), and the vertices of leaves. Leaves of
// several sizes separate the two.
#include <array>
#include <cstdio>
#include <memory>

#include "deformable_mesh.hpp"
#include "processor_time.hpp"
#include "spread.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

constexpr std::array<unsigned, 4> leaf_sizes = {2, 4, 8, format::plain_leaf::max_triangles};

struct Run {
    unsigned leaf_triangles;
    std::unique_ptr<DeformableMesh> mesh;
    std::vector<double> nanoseconds;
};

void print(const Subject& subject, const Run& run) {
    const RefitWork& work = run.mesh->work();
    JsonObject row = subject.row("nodes");
    row.add("most_leaf_triangles", std::size_t{run.leaf_triangles});
    row.add("nodes", work.nodes);
    row.add("leaves", work.leaves);
    row.add("leaf_vertices", work.leaf_vertices);
    row.add("moving_bytes", work.moving_bytes);
    add_spread(row, "ns", run.nanoseconds, 0);
    row.print();
}

}  // namespace

void measure_nodes(const Subject& subject) {
    std::vector<Run> runs;
    for (const unsigned size : leaf_sizes)
        runs.push_back(
            {size,
             std::make_unique<DeformableMesh>(subject.rest(), DeformableOptions{.range = subject.range(),
                                                                                .bits = subject.options().bits,
                                                                                .max_leaf_triangles = size}),
             {}});
    for (std::size_t round = 0; round < subject.options().rounds; ++round) {
        std::vector<double> seconds(runs.size());
        for (const Pose& pose : subject.poses())
            for (std::size_t i = 0; i < runs.size(); ++i) {
                runs[i].mesh->move(subject.rest().positions);
                const ProcessorTime time;
                runs[i].mesh->move(pose.positions);
                seconds[i] += time.seconds();
            }
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i].nanoseconds.push_back(1e9 * seconds[i] / static_cast<double>(subject.poses().size()));
    }
    for (const Run& run : runs) print(subject, run);
    std::fflush(stdout);
}

}  // namespace espalier::bench
