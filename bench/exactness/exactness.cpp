// What exactness costs and what its lack costs: rays aimed at edges and vertices, which float kernels lose; the time of
// kernels in float, double and integers; bytes, error and time of lattices. A JSON object a line.

#include "../peers/system.hpp"
#include "../program.hpp"
#include "kernels.hpp"

namespace espalier::bench {
namespace {

Mesh named(const char* name, Mesh mesh) {
    mesh.name = name;
    return mesh;
}

/// Closed meshes, of triangles of nearly equal size, of slim ones around two poles, and with a hole.
std::vector<Mesh> closed_meshes() {
    return {named("sphere", tests::make_icosphere(5, 1.0, {0.3f, 0.2f, 0.1f})),
            named("sphere with poles", tests::make_uv_sphere(100, 100, 1.0, {0.3f, 0.2f, 0.1f})),
            named("torus", tests::make_torus(200, 50, 1.0, 0.3))};
}

/// At a size at which no system's absolute thresholds matter.
SnappedMesh prepare(Mesh mesh) {
    bring_to_common_size(mesh);
    return snap_mesh(mesh);
}

struct AimedRays {
    AimedAt aim;
    std::vector<EdgeRay> rays;
};

std::vector<AimedRays> aim_everywhere(const SnappedMesh& snapped, std::size_t count) {
    std::vector<AimedRays> groups;
    for (const AimedAt aim : all_aims) groups.push_back({aim, edge_rays(snapped, aim, count, 10)});
    return groups;
}

void print_row(const SnappedMesh& snapped, const std::string& system, const AimedRays& group, std::size_t leaks) {
    JsonObject row = guide_row("leaks", snapped.mesh.name, snapped.mesh.triangles.size());
    row.add("system", system);
    row.add("aim", std::string(name_of(group.aim)));
    row.add("rays", group.rays.size());
    row.add("leaks", leaks);
    row.print();
}

template <class Kernel>
void print_kernel(const SnappedMesh& snapped, const AabbTree& tree, const Blob& blob, const std::string& name,
                  const std::vector<AimedRays>& groups) {
    const Kernel kernel(tree, blob);
    RayWalk walk(tree);
    for (const AimedRays& group : groups) {
        const auto leaks = std::ranges::count_if(
            group.rays, [&](const EdgeRay& ray) { return is_leak(ray, closest_hit(walk, kernel, ray.ray)); });
        print_row(snapped, name, group, static_cast<std::size_t>(leaks));
    }
}

/// Returns the rays with directions of length 1, as floats represent them: they are no longer exact.
std::vector<AimedRays> with_unit_directions(std::vector<AimedRays> groups) {
    for (AimedRays& group : groups)
        for (EdgeRay& aimed : group.rays) {
            Vec3& d = aimed.ray.direction;
            const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
            d = {d.x / length, d.y / length, d.z / length};
            aimed.farthest *= length;
        }
    return groups;
}

void print_system(const SnappedMesh& snapped, System& system, const std::string& name,
                  const std::vector<AimedRays>& groups) {
    for (const AimedRays& group : groups) {
        std::vector<Ray> rays;
        for (const EdgeRay& aimed : group.rays) rays.push_back(aimed.ray);
        std::vector<Hit> hits(rays.size());
        system.closest(rays, false, hits);
        std::size_t leaks = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            leaks += is_leak(group.rays[i], hits[i].found ? hits[i].t : std::numeric_limits<float>::infinity());
        print_row(snapped, name, group, leaks);
        if (leaks > 0 && name.starts_with("espalier"))
            throw std::runtime_error(snapped.mesh.name + ": " + std::to_string(leaks) + " rays pass between triangles");
    }
}

/// One of each: variants of a system that test triangles in the same way are left out.
std::vector<Maker> makers() {
    std::vector<Maker> chosen;
    for (Maker& maker : all_makers({})) {
        const bool is_variant = maker.name == "fcl" || maker.profile.starts_with("compact") ||
                                (maker.name == "espalier" && maker.profile != "fast");
        if (!is_variant) chosen.push_back(std::move(maker));
    }
    return chosen;
}

/// Prints a row for each system and kind of place: how many aimed rays pass between triangles. Throws
/// std::runtime_error if one passes Espalier.
void print_leaks(const SnappedMesh& snapped, const ExactnessOptions& options) {
    const std::vector<AimedRays> groups = aim_everywhere(snapped, options.aimed);
    const TreeAndBlob built = build_tree_and_blob(snapped.mesh, options.leaf_triangles);
    const Blob& blob = built.baked.blob;
    print_kernel<MollerTrumbore<float>>(snapped, built.tree, blob, "Möller–Trumbore in float", groups);
    print_kernel<MollerTrumbore<double>>(snapped, built.tree, blob, "Möller–Trumbore in double", groups);
    print_kernel<Watertight>(snapped, built.tree, blob, "watertight in float", groups);
    print_kernel<Integers>(snapped, built.tree, blob, "integers", groups);
    // ODE makes directions unit vectors itself, and counts t in their length.
    const std::vector<AimedRays> unit_groups = with_unit_directions(groups);
    for (const Maker& maker : makers())
        print_system(snapped, *maker.make(snapped.mesh), maker.name + " " + maker.profile,
                     maker.name == "ode" ? unit_groups : groups);
}

constexpr unsigned fewest_bits = 8, most_bits = 20, every = 2;

struct OnLattice {
    unsigned bits;
    BakedBlob made;
    std::vector<double> times = {};
    std::size_t hits = 0;
};

/// Prints a row for each lattice: bytes, error and the time of a ray.
void print_lattices(const Mesh& mesh, const ExactnessOptions& options) {
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    std::vector<OnLattice> lattices;
    for (unsigned bits = fewest_bits; bits <= most_bits; bits += every)
        lattices.push_back(
            {bits, bake_blob(mesh, BakeOptions{.resolution = Resolution::bits(bits), .effort = Effort::fast})});
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (OnLattice& lattice : lattices) {
            const Stopwatch watch;
            std::size_t hits = 0;
            for (const Ray& ray : rays) hits += bool(raycast(lattice.made.blob, ray));
            lattice.times.push_back(1e9 * watch.seconds() / static_cast<double>(rays.size()));
            lattice.hits = hits;
        }
    const auto triangles = static_cast<double>(mesh.triangles.size());
    for (const OnLattice& lattice : lattices) {
        const BakeReport& report = lattice.made.baked.report;
        JsonObject row = guide_row("lattices", mesh.name, mesh.triangles.size());
        row.add("bits", std::size_t{lattice.bits});
        row.add("bytes_per_triangle", static_cast<double>(lattice.made.baked.bytes.size()) / triangles, 3);
        row.add("kept_triangles", std::size_t{report.tree.triangles});
        row.add("error_of_extent", report.lattice.max_error / report.bounds.extent, 9);
        row.add("ns_per_ray", median_of(lattice.times), 1);
        row.add("rays", rays.size());
        row.add("hits", lattice.hits);
        row.add("rounds", options.rounds);
        row.print();
    }
}

}  // namespace

const Subcommand subcommand("exactness", [](int count, char** words) {
    ExactnessOptions options;
    Program program("espalier_bench_study exactness", "Rays lost between triangles, and what integers cost; JSON");
    program.allow_no_meshes();
    program.add_count("--aimed", options.aimed, "Rays at each kind of place");
    program.add_count("--rays", options.rays, "Rays of which times are measured");
    program.add_count("--rounds", options.rounds, "Rounds in which kernels and lattices take turns");
    program.add_number("--leaf", options.leaf_triangles, 1u, 64u, "Most triangles of a leaf of the textbook tree");
    return program.run(count, words, [&](const std::vector<std::string>& files) {
        for (const Mesh& mesh : closed_meshes()) print_leaks(prepare(mesh), options);
        for (const std::string& file : files) {
            const Mesh mesh = tests::read_mesh(file);
            const SnappedMesh snapped = prepare(mesh);
            std::fprintf(stderr, "%s\n", mesh.name.c_str());
            print_leaks(snapped, options);
            print_kernel_times(snapped, options);
            print_lattices(mesh, options);
        }
    });
});

}  // namespace espalier::bench
