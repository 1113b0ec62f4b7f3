// Many instances of one mesh or of some, and a mesh alone; or a baked scene, and its triangles in one mesh.
// Interleaved; one JSON object a line.

#include "../program.hpp"
#include "scenes.hpp"

namespace espalier::bench {
namespace {

struct Options {
    std::size_t instances = 10'000;
    std::size_t copies = 1;
    std::size_t rays = 100'000;
    std::size_t repetitions = 5;
};

/// Returns the mesh, each of its coordinates scaled by another factor near 1: as much work, other bytes.
Mesh variant_of(const Mesh& mesh, std::size_t number) {
    Mesh variant = mesh;
    const float factor = 1.0f + 0.01f * static_cast<float>(number);
    for (Vec3& p : variant.positions) p = {p.x * factor, p.y, p.z / factor};
    return variant;
}

/// Places instances anywhere in a cube, turned at random; their boxes together have half of its volume.
Placed place(const Mesh& mesh, const Options& options) {
    Placed placed;
    for (std::size_t i = 0; i < options.copies; ++i) placed.meshes.push_back(variant_of(mesh, i));
    const BoundingSphere sphere = bounding_sphere(mesh);
    const double side = 2.0 * static_cast<double>(sphere.radius) / std::sqrt(3.0);
    const double world = std::cbrt(2.0 * static_cast<double>(options.instances)) * side;
    tests::Random random(seed);
    placed.instances.resize(options.instances);
    for (std::size_t i = 0; i < placed.instances.size(); ++i) {
        Instance& instance = placed.instances[i];
        instance.mesh = static_cast<std::uint32_t>(i % options.copies);
        Transform& t = instance.transform;
        t.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()};
        const Vec3 at = random.in_cube(static_cast<float>(world) / 2);
        const Vec3 middle = direction_to_world(t, sphere.center);
        t.translation = {at.x - middle.x, at.y - middle.y, at.z - middle.z};
    }
    return placed;
}

/// A mesh that has the corners of the world's box, for the rays.
Mesh corners_of(const Placed& placed) {
    Mesh mesh;
    for (const Instance& instance : placed.instances) mesh.positions.push_back(instance.transform.translation);
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.triangles.push_back({i, i, i});
    return mesh;
}

/// Adds those of peers.
SceneContest with_peers(SceneContest contest, const Placed& placed) {
    static_cast<void>(placed);
#ifdef ESPALIER_BENCH_EMBREE
    add_embree_scene(placed, contest);
#endif
    return contest;
}
SceneContest contest_in(const Placed& placed) {
    SceneContest contest;
    add_espalier_scenes(placed, contest);
    return with_peers(std::move(contest), placed);
}

/// Returns how many rays have another hit than in the reference.
std::size_t differing(const std::vector<float>& hits, const std::vector<float>& reference) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const float a = hits[i], b = reference[i];
        if (a != b && !(std::abs(a - b) <= 1e-3f * std::abs(b))) ++count;
    }
    return count;
}

/// Two scenes, each with its rays.
struct Side {
    const char* name;
    SceneContest contest;
    const std::vector<Ray>& rays;
};

void measure(const std::string& name, std::size_t triangles, std::array<Side, 2> sides, const Options& options) {
    for (std::size_t repetition = 0; repetition < options.repetitions; ++repetition)
        for (Side& side : sides) take_turns(side.contest, std::span<const Ray>(side.rays), 1);
    for (const Side& side : sides)
        for (const auto& own : side.contest) {
            const auto& reference = side.contest.back();
            const Spread ratios = ratio(reference.seconds, own.seconds);
            JsonObject row;
            row.add("mesh", name);
            row.add("triangles", triangles);
            add_machine(row);
            row.add("scene", side.name);
            row.add("instances", options.instances);
            row.add("copies", options.copies);
            row.add("system", own.system);
            row.add("profile", own.profile);
            row.add("us_per_ray", 1e6 * median_of(own.seconds) / static_cast<double>(options.rays), 4);
            row.add_raw("ratio_to_last",
                        json_list({decimal(ratios.low, 3), decimal(ratios.median, 3), decimal(ratios.high, 3)}));
            row.add("bytes", own.bytes);
            row.add("rays_that_differ", differing(own.answers, reference.answers));
            row.print();
        }
}

void run_mesh(const std::string& file, const Options& options) {
    Mesh mesh = tests::read_mesh(file);
    bring_to_common_size(mesh);
    const Placed placed = place(mesh, options);
    const std::vector<Ray> into_scene = incoherent_rays(corners_of(placed), options.rays, seed);
    const std::vector<Ray> into_mesh = incoherent_rays(mesh, options.rays, seed);
    measure(mesh.name, mesh.triangles.size(),
            {Side{"instances", contest_in(placed), into_scene}, Side{"alone", contest_in({{mesh}, {}}), into_mesh}},
            options);
}

void run_scene(const std::string& path, Options options) {
    const SceneFile file(path);
    const Mesh flattened = file.flattened();
    const std::vector<Ray> rays = incoherent_rays(flattened, options.rays, seed);
    options.instances = file.placed.instances.size();
    options.copies = file.placed.meshes.size();
    SceneContest baked;
    add_baked_scene(file.bytes, baked);
    measure(path, flattened.triangles.size(),
            {Side{"instances", with_peers(std::move(baked), file.placed), rays},
             Side{"flattened", contest_in({{flattened}, {}}), rays}},
            options);
}

}  // namespace

const Subcommand subcommand("scenes", [](int count, char** words) {
    Options options;
    Program program(
        "espalier_bench_peers scenes",
        "Rays into many instances of a mesh, and into the mesh alone; or into a baked scene, SCENE.esps, and "
        "into its triangles in one mesh; JSON");
    program.add_count("--instances", options.instances, "Instances in the scene");
    program.add_count("--copies", options.copies, "Different meshes, made from the one by scaling it along two axes");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--repetitions", options.repetitions, "How often each system is asked; the median counts");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& file : meshes)
            file.ends_with(".esps") ? run_scene(file, options) : run_mesh(file, options);
    });
});

}  // namespace espalier::bench
