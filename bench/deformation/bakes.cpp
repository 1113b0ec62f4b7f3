// The time of a bake in place of a refit.
#include <cstdio>

#include "../../tools/base/choices.hpp"
#include "deformable_mesh.hpp"
#include "spread.hpp"
#include "subject.hpp"

namespace espalier::bench {

void measure_bakes(const Subject& subject) {
    const Mesh posed = subject.moving().posed(Motion::bend, 1.0);
    for (const auto& [name, effort] : tools::effort_choices) {
        std::vector<double> nanoseconds;
        for (std::size_t round = 0; round < subject.options().rounds; ++round) {
            const DeformableMesh baked(posed,
                                       {.range = subject.range(), .bits = subject.options().bits, .effort = effort});
            nanoseconds.push_back(1e9 * baked.bake_seconds() / subject.triangles());
        }
        JsonObject row = subject.row("bake");
        row.add("effort", std::string(name));
        add_spread(row, "ns_per_triangle", nanoseconds, 1);
        row.print();
        std::fflush(stdout);
    }
}

}  // namespace espalier::bench
