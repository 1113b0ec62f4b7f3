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

void add_distance(JsonObject& row, const std::string& name, const OneWayDistance& distance, double step) {
    row.add_raw(name, json_list({digits_of(distance.lower / step, 9), digits_of(distance.upper / step, 9)}));
    row.add(name + "_pieces", distance.pieces);
}

/// Throws when what the header promises does not hold, as far as that is proved.
void check_promise(double max_error, const OneWayDistance& one, const OneWayDistance& other) {
    const double proved = std::max(one.lower, other.lower);
    if (proved > max_error)
        throw std::runtime_error("the surfaces are " + std::to_string(proved) + " apart, the header says at most " +
                                 std::to_string(max_error));
}

BakedBlob on_lattice(const Mesh& mesh, unsigned bits) {
    return bake_blob(mesh, BakeOptions{.resolution = Resolution::bits(bits)});
}

/// Returns what all rows begin with.
JsonObject head_of(const Mesh& mesh, unsigned bits) {
    JsonObject row;
    row.add("mesh", mesh.name);
    row.add("source_triangles", mesh.triangles.size());
    row.add("bits", std::size_t{bits});
    return row;
}

void measure(const tests::Mesh& mesh, const Options& options) {
    const DoubleTree source(source_surface(mesh));
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, 2026);
    const std::vector<ReferenceHit> references = reference_hits(source, rays);
    for (unsigned bits = fewest_bits; bits <= most_bits;
         bits += static_cast<unsigned>(std::min<std::size_t>(options.every, most_bits))) {
        const BakedBlob lattice = on_lattice(mesh, bits);
        const BakeReport& report = lattice.baked.report;
        JsonObject row = head_of(mesh, bits);
        row.add_raw("step", digits_of(report.lattice.step, 9));
        row.add_raw("extent", digits_of(report.bounds.extent, 9));
        row.add("triangles", std::size_t{report.tree.triangles});
        row.add("zero_area", std::size_t{report.findings.zero_area.count});
        row.add("collapsed", std::size_t{report.findings.collapsed.count});
        row.add("duplicate", std::size_t{report.findings.duplicate.count});
        row.add("bytes", std::size_t{report.bytes});
        const DoubleTree baked(baked_surface(lattice.baked.bytes));
        const OneWayDistance to_baked = one_way_distance(source, baked, options.pieces);
        const OneWayDistance to_source = one_way_distance(baked, source, options.pieces);
        const double max_error = static_cast<double>(lattice.blob.max_error());
        row.add_raw("max_error_steps", digits_of(max_error / report.lattice.step, 9));
        add_distance(row, "to_baked_steps", to_baked, report.lattice.step);
        add_distance(row, "to_source_steps", to_source, report.lattice.step);
        add_ray_accuracy(row, lattice.blob, source, rays, references, options.points);
        row.print();
        std::fflush(stdout);
        check_promise(max_error, to_baked, to_source);
    }
    const BakedBlob lattice = on_lattice(mesh, approximate_bits);
    print_approximate_accuracy(head_of(mesh, approximate_bits), lattice.blob, mesh, source, options.questions);
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
