// workload_here every|usual|scene|moving|refit BLOB: asks on this machine what image/measure_main.cpp,
// measure_scene_main.cpp, measure_moving_main.cpp and measure_refit_main.cpp ask on a core, and prints the same line.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

#include <espalier/espalier.hpp>

#include "../platform/report.hpp"
#include "moving_workload.hpp"
#include "refit_workload.hpp"
#include "scene_workload.hpp"
#include "workload.hpp"

namespace {

using namespace espalier;

constexpr auto just_call = [](unsigned, FunctionRef<void()> call) { call(); };

int finish(const char* path, OpenStatus status, const platform::Fingerprint& answers) {
    if (status != OpenStatus::ok) {
        std::fprintf(stderr, "workload_here: %s: %s\n", path, describe(status));
        return 2;
    }
    std::fputs(firmware::workload_line(answers).c_str(), stdout);
    return 0;
}

int ask_blob(const char* path, std::span<const std::byte> bytes, bool every) {
    const Blob blob = open(bytes);
    if (!blob) return finish(path, blob.status(), {});
    firmware::Workload workload(bytes, blob, just_call);
    workload.ask_usual({});
    if (every) workload.ask_others({});
    return finish(path, OpenStatus::ok, workload.answers());
}

int ask_scene(const char* path, std::span<const std::byte> bytes) {
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    const BakedScene scene = open_scene(bytes, meshes);
    if (!scene) return finish(path, scene.status(), {});
    firmware::SceneWorkload workload(bytes, std::span(meshes), scene, just_call);
    workload.ask(firmware::Counts{}.usual);
    return finish(path, OpenStatus::ok, workload.answers());
}

int ask_moving(const char* path, std::span<const std::byte> bytes) {
    const Blob cube = open(bytes);
    if (!cube) return finish(path, cube.status(), {});
    alignas(32) std::byte block[firmware::mover_block_bytes];
    firmware::MovingWorkload workload(block, cube, just_call);
    workload.ask(firmware::Counts{}.steps);
    return finish(path, OpenStatus::ok, workload.answers());
}

int ask_refit(const char* path, std::span<const std::byte> bytes) {
    const Blob cloth = open(bytes);
    if (!cloth) return finish(path, cloth.status(), {});
    std::vector<std::byte> memory(deformable_bytes(cloth));
    std::vector<Vec3> positions(firmware::ClothPlaces::count);
    firmware::RefitWorkload workload(memory, positions, cloth, just_call);
    workload.ask(firmware::Counts{}.poses);
    return finish(path, OpenStatus::ok, workload.answers());
}

}  // namespace

int main(int argument_count, char** arguments) {
    const std::string_view queries = argument_count == 3 ? arguments[1] : "";
    if (queries != "every" && queries != "usual" && queries != "scene" && queries != "moving" && queries != "refit") {
        std::fputs("usage: workload_here every|usual|scene|moving|refit BLOB\n", stderr);
        return 1;
    }
    std::ifstream file(arguments[2], std::ios::binary);
    const std::vector<char> characters{std::istreambuf_iterator<char>(file), {}};
    const std::span<const std::byte> bytes = std::as_bytes(std::span(characters));
    if (queries == "scene") return ask_scene(arguments[2], bytes);
    if (queries == "moving") return ask_moving(arguments[2], bytes);
    if (queries == "refit") return ask_refit(arguments[2], bytes);
    return ask_blob(arguments[2], bytes, queries == "every");
}
