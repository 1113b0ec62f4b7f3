// Many instances of one mesh or of some, and a mesh alone; or a baked scene, and its triangles in one mesh.
// Interleaved; one JSON object a line.

#include "../program.hpp"
#include "scene_system.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

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

struct Run {
    std::string name;
    std::unique_ptr<SceneSystem> system;
    std::vector<double> seconds;
    std::vector<float> hits;
};

/// Returns the given makers, and those of peers.
std::vector<SceneMaker> with_peers(std::vector<SceneMaker> makers) {
#ifdef ESPALIER_BENCH_EMBREE
    for (SceneMaker& maker : embree_scene_makers()) makers.push_back(std::move(maker));
#endif
    return makers;
}

std::vector<Run> make_runs(const std::vector<SceneMaker>& makers, const Placed& placed, std::size_t rays) {
    std::vector<Run> runs;
    for (const SceneMaker& maker : with_peers(makers))
        runs.push_back({maker.system + " " + maker.profile, maker.make(placed), {}, std::vector<float>(rays)});
    return runs;
}

void ask(std::vector<Run>& runs, const std::vector<Ray>& rays) {
    for (Run& run : runs) {
        const Stopwatch watch;
        run.system->closest(rays, run.hits);
        run.seconds.push_back(watch.seconds());
    }
}

/// Returns how many rays have another hit than in the reference.
std::size_t differing(const Run& run, const Run& reference) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < run.hits.size(); ++i) {
        const float a = run.hits[i], b = reference.hits[i];
        if (a != b && !(std::abs(a - b) <= 1e-3f * std::abs(b))) ++count;
    }
    return count;
}

void print(const std::string& name, std::size_t triangles, const char* what, const Options& options,
           const std::vector<Run>& runs) {
    const Run& reference = runs.back();
    for (const Run& run : runs) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < run.seconds.size(); ++i) ratios.push_back(reference.seconds[i] / run.seconds[i]);
        std::sort(ratios.begin(), ratios.end());
        std::printf(
            "{\"mesh\":\"%s\",\"triangles\":%zu,\"scene\":\"%s\",\"instances\":%zu,\"copies\":%zu,\"system\":\"%s\","
            "\"us_per_ray\":%.4f,\"ratio_to_last\":[%.3f,%.3f,%.3f],\"bytes\":%zu,\"rays_that_differ\":%zu}\n",
            name.c_str(), triangles, what, options.instances, options.copies, run.name.c_str(),
            1e6 * median_of(run.seconds) / static_cast<double>(options.rays), ratios.front(), ratios[ratios.size() / 2],
            ratios.back(), run.system->bytes(), differing(run, reference));
    }
    std::fflush(stdout);
}

void run_mesh(const std::string& file, const Options& options) {
    Mesh mesh = tests::read_mesh(file);
    bring_to_common_size(mesh);
    const Placed placed = place(mesh, options);
    const std::vector<Ray> into_scene = incoherent_rays(corners_of(placed), options.rays, seed);
    const std::vector<Ray> into_mesh = incoherent_rays(mesh, options.rays, seed);
    const std::vector<SceneMaker> makers = espalier_scene_makers();
    std::vector<Run> scenes = make_runs(makers, placed, options.rays);
    std::vector<Run> alone = make_runs(makers, {{mesh}, {}}, options.rays);
    for (std::size_t repetition = 0; repetition < options.repetitions; ++repetition) {
        ask(scenes, into_scene);
        ask(alone, into_mesh);
    }
    print(mesh.name, mesh.triangles.size(), "instances", options, scenes);
    print(mesh.name, mesh.triangles.size(), "alone", options, alone);
}

void run_scene(const std::string& path, Options options) {
    const SceneFile file(path);
    const Mesh flattened = file.flattened();
    const std::vector<Ray> rays = incoherent_rays(flattened, options.rays, seed);
    std::vector<Run> scenes = make_runs(baked_scene_makers(file.bytes), file.placed, options.rays);
    std::vector<Run> merged = make_runs(espalier_scene_makers(), {{flattened}, {}}, options.rays);
    for (std::size_t repetition = 0; repetition < options.repetitions; ++repetition) {
        ask(scenes, rays);
        ask(merged, rays);
    }
    options.instances = file.placed.instances.size();
    options.copies = file.placed.meshes.size();
    print(path, flattened.triangles.size(), "instances", options, scenes);
    print(path, flattened.triangles.size(), "flattened", options, merged);
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program(
        "espalier_bench_scenes",
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
}
