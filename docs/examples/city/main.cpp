// city SCENE.esps [FLAT.espl]: makes a town, bakes it as a scene, writes it, and queries it as a game does: lines of
// sight, falls, and a camera. With FLAT.espl also bakes all triangles into one blob, to compare.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/scenes/bake.hpp>

#include "town.hpp"

namespace {

using namespace espalier;

constexpr int step_exponent = -8;  // 4 mm: vertices are whole multiples of 16 mm, so that nothing is rounded
constexpr const char* kind_names[] = {"the ground", "a house", "a tree", "a lamp"};

double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool write_file(const char* path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return file.good();
}

/// Bakes each mesh once, and joins them in a scene.
SceneBakeResult bake_town(const city::Town& town) {
    BakeOptions options;
    options.resolution = Resolution::step(step_exponent);
    std::vector<BakeResult> baked;
    std::vector<std::span<const std::byte>> blobs;
    for (const city::Solid& mesh : town.meshes) {
        const MeshView view = mesh.view();
        baked.push_back(bake(std::span(&view, 1), options));
        if (baked.back()) continue;
        SceneBakeResult refused;
        refused.message = baked.back().message;
        return refused;
    }
    for (const BakeResult& mesh : baked) blobs.emplace_back(mesh.bytes);
    return bake_scene(blobs, town.instances);
}

/// Bakes the triangles of all instances into one blob.
BakeResult bake_flat(const city::Town& town) {
    std::vector<std::vector<Vec3>> positions;
    std::vector<MeshView> views;
    for (const Instance& instance : town.instances) {
        const MeshView mesh = town.meshes[instance.mesh].view();
        std::vector<Vec3>& moved = positions.emplace_back();
        for (const Vec3& point : mesh.positions) moved.push_back(to_world(instance.transform, point));
        views.push_back({moved, mesh.triangles, {}, 0, 0, {}});
    }
    BakeOptions options;
    options.resolution = Resolution::step(step_exponent);
    return bake(views, options);
}

/// Returns a place 1.7 m above the ground, at coordinates in metres.
Vec3 eye_at(int x, int y) {
    return {static_cast<float>(x), static_cast<float>(y), city::in_metres(city::ground_height(x, y)) + 1.7f};
}

/// Returns whether one place is seen from another, and whether trees alone are in the way: a mask leaves them out.
const char* sight_between(const BakedScene& scene, const Vec3& from, const Vec3& to) {
    const Ray ray = {.origin = from, .direction = {to.x - from.x, to.y - from.y, to.z - from.z}, .t_max = 1.0f};
    if (!occluded(scene, ray).yes()) return "free";
    return occluded(scene, ray, ~city::mask_of(city::Kind::tree)).yes() ? "hidden" : "hidden by trees";
}

void look(const BakedScene& scene) {
    std::printf("sight    along a street: %s; through a yard: %s; across a block: %s\n",
                sight_between(scene, eye_at(512, 450), eye_at(512, 560)),
                sight_between(scene, eye_at(586, 480), eye_at(630, 480)),
                sight_between(scene, eye_at(512, 450), eye_at(576, 500)));
}

void drop(const BakedScene& scene) {
    unsigned fell_on[4] = {};
    constexpr int count = 1000;
    for (int i = 0; i < count; ++i) {
        const Sphere ball = {{static_cast<float>(i * 37 % 1000 + 8), static_cast<float>(i * 91 % 1000 + 8), 200.0f},
                             0.25f};
        const InScene<SweepHit> hit = sweep(scene, ball, {0.0f, 0.0f, -300.0f});
        if (hit) ++fell_on[instance_at(scene, hit.instance)->user];
    }
    std::printf("fall     %d balls from 200 m:", count);
    for (int kind = 0; kind < 4; ++kind)
        std::printf("%s %u on %s", kind == 0 ? "" : ",", fell_on[kind], kind_names[kind]);
    std::printf("\n");
}

void photograph(const BakedScene& scene) {
    constexpr int width = 640, height = 360;
    unsigned pixels[5] = {};
    const Vec3 eye = {512.0f, -150.0f, 130.0f};
    const double seconds = seconds_of([&] {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Vec3 direction = {static_cast<float>(x - width / 2), static_cast<float>(width),
                                        static_cast<float>(height / 4 - y)};
                const InScene<RayHit> hit = raycast(scene, {.origin = eye, .direction = direction});
                ++pixels[hit ? instance_at(scene, hit.instance)->user : 4];
            }
    });
    std::printf("camera   %d x %d pixels, %.2f million rays a second on one core:", width, height,
                width * height * 1e-6 / seconds);
    for (int kind = 0; kind < 4; ++kind)
        std::printf(" %.0f %% %s,", 100.0 * pixels[kind] / (width * height), kind_names[kind]);
    std::printf(" %.0f %% sky\n", 100.0 * pixels[4] / (width * height));
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count < 2 || argument_count > 3) {
        std::fputs("usage: city SCENE.esps [FLAT.espl]\n", stderr);
        return 1;
    }
    const city::Town town = city::make_town();
    SceneBakeResult baked;
    const double seconds = seconds_of([&] { baked = bake_town(town); });
    if (!baked) {
        std::fprintf(stderr, "city: %s\n", baked.message.c_str());
        return 3;
    }
    if (!write_file(arguments[1], baked.bytes)) {
        std::fprintf(stderr, "city: cannot write %s\n", arguments[1]);
        return 2;
    }
    std::vector<Blob> meshes(mesh_count_of_scene(baked.bytes));
    const BakedScene scene = open_scene(baked.bytes, meshes);
    std::printf("city     %u instances of %u meshes, %llu triangles\n", scene.instance_count(), baked.report.meshes,
                static_cast<unsigned long long>(baked.report.triangles));
    std::printf("scene    %.0f KiB, baked in %.2f s: %s\n", static_cast<double>(baked.bytes.size()) / 1024, seconds,
                arguments[1]);
    look(scene);
    drop(scene);
    photograph(scene);
    if (argument_count == 3) {
        BakeResult flat;
        const double flat_seconds = seconds_of([&] { flat = bake_flat(town); });
        if (!flat || !write_file(arguments[2], flat.bytes)) {
            std::fprintf(stderr, "city: cannot bake or write %s: %s\n", arguments[2], flat.message.c_str());
            return 2;
        }
        std::printf("flat     %.0f KiB, baked in %.2f s: all triangles in one blob, %s\n",
                    static_cast<double>(flat.bytes.size()) / 1024, flat_seconds, arguments[2]);
    }
    return 0;
}
