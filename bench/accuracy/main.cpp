// How far a blob's answers are from the source mesh, for lattices from 8 to 20 bits, and how far those of the
// approximate queries: JSON, an object a line. The source is judged by a tree in double precision that shares no code
// with the library.

#include "../../tests/oracle/double_tree.hpp"
#include "../../tests/oracle/hausdorff.hpp"
#include "../../tests/oracle/surfaces.hpp"
#include "../program.hpp"
#include "accuracy.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;
using namespace espalier::reference;

struct Options {
    std::size_t rays = 2'000'000;
    std::size_t points = 100'000;    ///< hits whose point is held against the source's surface
    std::size_t questions = 20'000;  ///< of each approximate query
    std::size_t pieces = 500'000;    ///< of halved triangles, for each way of the Hausdorff distance
    std::size_t every = 1;           ///< every how many bits there is a lattice
};

constexpr unsigned fewest_bits = 8, most_bits = 20;
constexpr unsigned approximate_bits = 16;

void print_distance(const char* name, const OneWayDistance& distance, double step) {
    std::printf(",\"%s\":[%.9g,%.9g],\"%s_pieces\":%zu", name, distance.lower / step, distance.upper / step, name,
                distance.pieces);
}

/// Throws when what the header promises does not hold, as far as that is proved.
void check_promise(double max_error, const OneWayDistance& one, const OneWayDistance& other) {
    const double proved = std::max(one.lower, other.lower);
    if (proved > max_error)
        throw std::runtime_error("the surfaces are " + std::to_string(proved) + " apart, the header says at most " +
                                 std::to_string(max_error));
}

BakedBlob on_lattice(const Mesh& mesh, unsigned bits) {
    BakeOptions options;
    options.resolution = Resolution::bits(bits);
    return bake_blob(mesh, options);
}

void measure(const tests::Mesh& mesh, const Options& options) {
    const DoubleTree source(source_surface(mesh));
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, 2026);
    const std::vector<ReferenceHit> references = reference_hits(source, rays);
    for (unsigned bits = fewest_bits; bits <= most_bits;
         bits += static_cast<unsigned>(std::min<std::size_t>(options.every, most_bits))) {
        const BakedBlob lattice = on_lattice(mesh, bits);
        const BakeReport& report = lattice.baked.report;
        std::printf("{\"mesh\":\"%s\",\"source_triangles\":%zu,\"bits\":%u,\"step\":%.9g,\"extent\":%.9g",
                    mesh.name.c_str(), mesh.triangles.size(), bits, report.lattice.step, report.bounds.extent);
        std::printf(",\"triangles\":%u,\"zero_area\":%llu,\"collapsed\":%llu,\"duplicate\":%llu,\"bytes\":%llu",
                    report.tree.triangles, static_cast<unsigned long long>(report.findings.zero_area.count),
                    static_cast<unsigned long long>(report.findings.collapsed.count),
                    static_cast<unsigned long long>(report.findings.duplicate.count),
                    static_cast<unsigned long long>(report.bytes));
        const DoubleTree baked(baked_surface(lattice.baked.bytes));
        const OneWayDistance to_baked = one_way_distance(source, baked, options.pieces);
        const OneWayDistance to_source = one_way_distance(baked, source, options.pieces);
        const double max_error = static_cast<double>(lattice.blob.max_error());
        std::printf(",\"max_error_steps\":%.9g", max_error / report.lattice.step);
        print_distance("to_baked_steps", to_baked, report.lattice.step);
        print_distance("to_source_steps", to_source, report.lattice.step);
        print_ray_accuracy(lattice.blob, source, rays, references, options.points);
        std::printf("}\n");
        std::fflush(stdout);
        check_promise(max_error, to_baked, to_source);
    }
    const BakedBlob lattice = on_lattice(mesh, approximate_bits);
    const std::string head = "{\"mesh\":\"" + mesh.name +
                             "\",\"source_triangles\":" + std::to_string(mesh.triangles.size()) +
                             ",\"bits\":" + std::to_string(approximate_bits);
    print_approximate_accuracy(head.c_str(), lattice.blob, mesh, source, options.questions);
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_accuracy",
                    "How far blobs of 8 to 20 bits are from their source, and the approximate queries; JSON");
    program.add_count("--rays", options.rays, "Rays at each lattice");
    program.add_count("--points", options.points, "Hits whose point is held against the source's surface");
    program.add_count("--questions", options.questions, "Questions of each approximate query");
    program.add_count("--pieces", options.pieces, "Pieces of triangles, for each way of the Hausdorff distance");
    program.add_count("--every", options.every, "Every how many bits there is a lattice");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& path : meshes) measure(tests::read_mesh(path), options);
    });
}
