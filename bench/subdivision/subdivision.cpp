// Subdivisions of space beside a hierarchy of volumes: a k-d tree and a uniform grid, in time, memory, and rays that
// get lost between cells. One thread; one JSON object a line.

#include "../study/study.hpp"
#include "structures.hpp"

namespace espalier::bench {
namespace {

struct Options {
    std::size_t rays = 20'000;
    std::size_t boxes = 5'000;
    std::size_t edge_rays = 100'000;
    std::size_t compared = 20;  ///< queries that are compared with a loop over all triangles
    std::size_t rounds = 5;
};

/// Boxes around points of the surface, with sides of a sixty-fourth of the mesh.
std::vector<Aabb> boxes_on_surface(const AabbTree& tree, std::size_t count) {
    const Aabb around = box_of(tree.triangles);
    float side = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) side = std::max(side, around.high[k] - around.low[k]);
    const float half = side / 128.0f;
    tests::Random random(seed);
    std::vector<Aabb> boxes;
    while (boxes.size() < count) {
        const Vec3& p =
            tree.triangles[random.below(static_cast<std::uint32_t>(tree.triangles.size()))][random.below(3)];
        boxes.push_back({{p.x - half, p.y - half, p.z - half}, {p.x + half, p.y + half, p.z + half}});
    }
    return boxes;
}

/// What a structure answered and took.
struct StructureRun {
    Structure* structure;
    Timed<double, RayWork> rays = {};
    Timed<std::size_t, RayWork> boxes = {};
};

void measure_round(StructureRun& run, const std::vector<Ray>& rays, const std::vector<Aabb>& boxes) {
    run.rays.make_round(rays, [&](const Ray& ray, RayWork& work) { return run.structure->closest(ray, work); });
    run.boxes.make_round(boxes,
                         [&](const Aabb& box, RayWork& work) { return run.structure->count_touching(box, work); });
}

/// Throws std::runtime_error if a structure has another answer than the loop over all triangles, or than the first.
void check_answers(const AabbTree& tree, const std::vector<StructureRun>& runs, const std::vector<Ray>& rays,
                   const std::vector<Aabb>& boxes, std::size_t compared) {
    const StructureRun& first = runs.front();
    for (std::size_t i = 0; i < std::min(compared, rays.size()); ++i)
        if (first.rays.answers[i] != closest_of_all(tree.triangles, rays[i]))
            throw std::runtime_error("a ray has another hit in a loop");
    for (std::size_t i = 0; i < std::min(compared, boxes.size()); ++i)
        if (first.boxes.answers[i] != touching_of_all(tree.triangles, boxes[i]))
            throw std::runtime_error("a box touches other triangles in a loop");
    for (const StructureRun& run : runs)
        if (run.structure->is_reference &&
            (run.rays.answers != first.rays.answers || run.boxes.answers != first.boxes.answers))
            throw std::runtime_error(run.structure->name + ": answers differ from those of the hierarchy");
}

std::size_t count_leaks(Structure& structure, const std::vector<EdgeRay>& rays) {
    RayWork work;
    std::size_t leaks = 0;
    for (const EdgeRay& aimed : rays)
        leaks += is_leak(aimed, static_cast<float>(structure.closest(aimed.ray, work))) ? 1u : 0u;
    return leaks;
}

void measure(Mesh mesh, const Options& options) {
    const SubdivisionSubject subject = make_subdivision_subject(std::move(mesh));
    const AabbTree& tree = subject.built.tree;
    const Mesh& snapped = subject.snapped.mesh;
    const std::vector<Ray> rays = incoherent_rays(snapped, options.rays, seed);
    const std::vector<Aabb> boxes = boxes_on_surface(tree, options.boxes);
    const FloatTest float_test(tree, subject.built.baked.blob);
    const auto structures = all_structures(subject), in_float = structures_with_float_test(subject, float_test);
    std::vector<StructureRun> runs;
    for (const auto& structure : structures) runs.push_back({structure.get()});
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (StructureRun& run : runs) measure_round(run, rays, boxes);
    check_answers(tree, runs, rays, boxes, options.compared);
    std::vector<EdgeRay> aimed;
    for (const AimedAt aim : all_aims)
        for (const EdgeRay& ray : edge_rays(subject.snapped, aim, options.edge_rays / all_aims.size(), seed))
            aimed.push_back(ray);
    const auto triangles = static_cast<double>(tree.triangles.size());
    for (const StructureRun& run : runs) {
        const Structure& structure = *run.structure;
        const auto mean = [&](std::uint64_t sum, std::size_t queries) {
            return structure.has_work ? std::optional(per(sum, queries)) : std::nullopt;
        };
        std::optional<std::size_t> lost_in_float;
        for (const auto& other : in_float)
            if (other->name == structure.name) lost_in_float = count_leaks(*other, aimed);
        JsonObject row = guide_row("subdivision", snapped.name, tree.triangles.size());
        row.add("structure", structure.name);
        row.add("build_ms", structure.is_reference ? std::optional(1e3 * structure.build_seconds) : std::nullopt, 2);
        row.add("cells", structure.cells);
        row.add("references_per_triangle", static_cast<double>(structure.references) / triangles, 3);
        row.add("bytes_per_triangle", static_cast<double>(structure.bytes) / triangles, 2);
        row.add("has_triangles", std::size_t{structure.has_triangles ? 1u : 0u});
        row.add("rays", rays.size());
        row.add("cells_per_ray", mean(run.rays.work.box_tests, rays.size()), 2);
        row.add("triangles_per_ray", mean(run.rays.work.triangle_tests, rays.size()), 2);
        add_spread(row, "ray_ns", run.rays.nanoseconds, 1);
        row.add("boxes", boxes.size());
        row.add("cells_per_box", mean(run.boxes.work.box_tests, boxes.size()), 2);
        row.add("triangles_per_box", mean(run.boxes.work.triangle_tests, boxes.size()), 2);
        add_spread(row, "box_ns", run.boxes.nanoseconds, 1);
        row.add("edge_rays", aimed.size());
        row.add("lost", count_leaks(*run.structure, aimed));
        row.add("lost_with_float_test", lost_in_float);
        row.add("rounds", options.rounds);
        row.print();
    }
}

}  // namespace

const Subcommand subcommand("subdivision", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_study subdivision",
                    "A k-d tree and a uniform grid beside a hierarchy of boxes; JSON");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--boxes", options.boxes, "Boxes on the surface");
    program.add_count("--edge-rays", options.edge_rays, "Rays at edges and vertices");
    program.add_count("--compared", options.compared, "Queries that are compared with a loop over all triangles");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run_on_meshes(count, words, [&](Mesh mesh) { measure(std::move(mesh), options); });
});

}  // namespace espalier::bench
