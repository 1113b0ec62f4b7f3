// Threads that bake and ask at the same time, for the thread sanitizer: it ends the program where two of them touch the
// same bytes without order. What they find is compared too.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/scenes/bake.hpp>
#include <espalier/scenes/pairs.hpp>

#include "../platform/answers.hpp"

namespace {

using namespace espalier;

constexpr std::uint32_t side = 64;  // 8192 triangles: enough that the baker shares its work between threads
constexpr unsigned askers = 4;
constexpr std::uint32_t questions = 40;  // of a kind

struct Ground {
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;
};

Ground make_ground() {
    Ground ground;
    for (std::uint32_t i = 0; i < (side + 1) * (side + 1); ++i) {
        const auto height = static_cast<float>(i * 2654435761u >> 24) * 0x1p-6f;
        ground.positions.push_back({static_cast<float>(i % (side + 1)), static_cast<float>(i / (side + 1)), height});
    }
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::uint32_t a = i / side * (side + 1) + i % side;
        ground.triangles.push_back({a, a + 1, a + side + 2});
        ground.triangles.push_back({a, a + side + 2, a + side + 1});
    }
    return ground;
}

std::vector<std::byte> bake_by(Builder builder, const Ground& ground, unsigned threads) {
    const MeshView view = {.positions = ground.positions, .triangles = ground.triangles};
    BakeOptions options;
    options.build.builder = builder;
    options.threads = threads;
    options.effort = Effort::fast;
    options.progress = [](const char*, double) {};
    if (builder == Builder::spatial_splits) options.profile = Profile::fast;
    auto baked = bake({&view, 1}, options);
    return baked ? std::move(baked.bytes) : std::vector<std::byte>();
}

/// Returns whether `ask()` returns the same in threads at the same time. They wait for each other at first, without an
/// order that would hide a race.
template <class Ask>
bool is_same_in_threads(Ask ask) {
    std::vector<std::uint64_t> found(askers);
    {
        std::atomic<unsigned> started = 0;
        std::vector<std::thread> threads;
        for (unsigned i = 0; i < askers; ++i) {
            threads.emplace_back([&, i] {
                started.fetch_add(1, std::memory_order_relaxed);
                while (started.load(std::memory_order_relaxed) < askers) std::this_thread::yield();
                found[i] = ask();
            });
        }
        for (std::thread& thread : threads) thread.join();
    }
    return std::count(found.begin(), found.end(), found[0]) == askers;
}

/// The first call of each thread also races to find out the instruction set.
bool ask_at_the_same_time(const std::vector<std::byte>& bytes) {
    const Blob blob = open(bytes);
    return blob && is_same_in_threads([&] { return platform::ask_everything(blob, questions).fingerprint.value(); });
}

Instance instance_at_place(std::uint32_t number) {
    Instance instance;
    instance.transform.translation = {static_cast<float>(number * 37 % 200), static_cast<float>(number * 61 % 170),
                                      0.0f};
    instance.transform.rotation.z = static_cast<float>(number % 5);
    return instance;
}

/// What a moving scene is asked about, made before the threads start.
struct Shapes {
    Ray ray;
    Sphere sphere;
    Box box;
    Vec3 point, way;
};

/// Asks a moving scene with every query that only reads.
std::uint64_t ask_moving_scene(const MovingScene& scene, const BakedScene& baked, const Shapes& shapes) {
    const auto& [ray, sphere, box, point, way] = shapes;
    platform::Fingerprint found;
    const auto add = [&](InstanceId instance) { found.add(instance.index); };
    add(raycast(scene, ray).instance);
    found.add(occluded(scene, ray).yes());
    static_cast<void>(for_each_hit(scene, ray, [&](InstanceId instance, const RayHit&) { add(instance); }));
    add(closest_point(scene, point).instance);
    add(sweep(scene, sphere, way).instance);
    add(sweep(scene, box, way).instance);
    found.add(overlaps(scene, sphere).yes());
    static_cast<void>(for_each_overlap(scene, sphere, [&](InstanceId instance, TriangleId) { add(instance); }));
    static_cast<void>(for_each_candidate(scene, box, add));
    BakedPair pairs[50];
    for (const BakedPair& pair : collect_candidate_pairs(scene, baked, pairs).in(pairs)) add({pair.moving});
    for (const BakedPair& pair : collect_colliding_pairs(scene, baked, pairs, WorkLimit(1'000)).in(pairs))
        add(pair.baked);
    found.add(quality(scene));
    return found.value();
}

bool ask_moving_scene_at_the_same_time(const std::vector<std::byte>& bytes) {
    constexpr std::uint32_t instances = 60;
    const Blob blob = open(bytes);
    const std::vector<std::span<const std::byte>> meshes = {bytes};
    const std::vector<Instance> places = {instance_at_place(7), instance_at_place(8)};
    const SceneBakeResult scene_bytes = bake_scene(meshes, places);
    std::vector<Blob> meshes_of_scene(1);
    const BakedScene baked = open_scene(scene_bytes.bytes, meshes_of_scene);
    alignas(32) static std::byte memory[instances * 200];
    MovingScene scene = create_moving_scene(memory, instances, -10, {&blob, 1});
    if (!blob || !baked || !scene) return false;
    for (std::uint32_t i = 0; i < instances; ++i)
        if (!insert(scene, instance_at_place(i))) return false;
    // Threads of few questions each: the sanitizer forgets what a thread has touched long ago.
    platform::Questions maker(blob);
    for (std::uint32_t i = 0; i < questions; ++i) {
        const Shapes shapes = {maker.ray(i), maker.sphere(i), maker.box(i), maker.point(i), maker.displacement(i)};
        if (!is_same_in_threads([&] { return ask_moving_scene(scene, baked, shapes); })) return false;
    }
    return true;
}

}  // namespace

int main() {
    const Ground ground = make_ground();
    for (const Builder builder : {Builder::binned_sah, Builder::sweep_sah, Builder::spatial_splits,
                                  Builder::agglomerative, Builder::linear, Builder::insertion}) {
        const std::vector<std::byte> bytes = bake_by(builder, ground, 4);
        if (bytes.empty() || bytes != bake_by(builder, ground, 1)) {
            std::fprintf(stderr, "builder %u: other bytes with 4 threads\n", static_cast<unsigned>(builder));
            return 1;
        }
        if (!ask_at_the_same_time(bytes)) {
            std::fprintf(stderr, "builder %u: other answers at the same time\n", static_cast<unsigned>(builder));
            return 2;
        }
    }
    if (!ask_moving_scene_at_the_same_time(bake_by(Builder::binned_sah, ground, 1))) {
        std::fputs("moving scene: other answers at the same time\n", stderr);
        return 3;
    }
    std::puts("6 builders with 4 threads, 4 threads asking each blob and a moving scene: no race");
    return 0;
}
