#include <stdexcept>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "../deformation/spread.hpp"
#include "../guide/row.hpp"
#include "../peers/stopwatch.hpp"
#include "options.hpp"

namespace espalier::bench {
namespace {

constexpr std::uint64_t seed = 2026;
constexpr unsigned fewest_bits = 8, most_bits = 20, every = 2;

struct OnLattice {
    unsigned bits;
    BakeResult baked;
    Blob blob;
    std::vector<double> times = {};
    std::size_t hits = 0;
};

OnLattice bake_on(const Mesh& mesh, unsigned bits) {
    BakeOptions options;
    options.resolution = Resolution::bits(bits);
    options.effort = Effort::fast;
    const MeshView view = mesh.view();
    OnLattice made{bits, bake({&view, 1}, options), {}};
    if (!made.baked) throw std::runtime_error(made.baked.message);
    made.blob = open(made.baked.bytes);
    return made;
}

}  // namespace

void print_lattices(const Mesh& mesh, const ExactnessOptions& options) {
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    std::vector<OnLattice> lattices;
    for (unsigned bits = fewest_bits; bits <= most_bits; bits += every) lattices.push_back(bake_on(mesh, bits));
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (OnLattice& lattice : lattices) {
            const Stopwatch watch;
            std::size_t hits = 0;
            for (const Ray& ray : rays) hits += bool(raycast(lattice.blob, ray));
            lattice.times.push_back(1e9 * watch.seconds() / static_cast<double>(rays.size()));
            lattice.hits = hits;
        }
    const auto triangles = static_cast<double>(mesh.triangles.size());
    for (const OnLattice& lattice : lattices) {
        const BakeReport& report = lattice.baked.report;
        JsonObject row = guide_row("lattices", mesh.name, mesh.triangles.size());
        row.add("bits", std::size_t{lattice.bits});
        row.add("bytes_per_triangle", static_cast<double>(lattice.baked.bytes.size()) / triangles, 3);
        row.add("kept_triangles", std::size_t{report.tree.triangles});
        row.add("error_of_extent", report.lattice.max_error / report.bounds.extent, 9);
        row.add("ns_per_ray", median_of(lattice.times), 1);
        row.add("rays", rays.size());
        row.add("hits", lattice.hits);
        row.add("rounds", options.rounds);
        row.print();
    }
}

}  // namespace espalier::bench
