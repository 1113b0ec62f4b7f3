// query_answers [--set NAME] [--moving] QUESTIONS BLOB...: opens each blob or scene, asks it, prints one line of
// answers for each; asks every two blobs that follow each other about both; and prints a line about all scenes, one
// about all blobs, one about moving scenes of the meshes and tiles of each scene, and one about all deformable blobs in
// some poses, which are not among the others. A line is left out where there is nothing that it is about. With
// --moving each blob has a second line, about a small moving scene of it. NAME is one of scalar, sse42, avx2 and
// avx512, to ask with that instruction set where the machine has it. Uses the runtime and C streams only, so that it
// runs wherever a C++ compiler reaches.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>
#include <runtime/lanes/select.hpp>

#include "answers.hpp"
#include "moving_answers.hpp"
#include "pose_answers.hpp"
#include "report.hpp"
#include "scene_answers.hpp"

using namespace espalier;

namespace {

std::vector<std::byte> read_file(const char* path) {
    std::vector<std::byte> bytes;
    std::FILE* file = std::fopen(path, "rb");
    if (file == nullptr) return bytes;
    std::byte chunk[4096];
    for (std::size_t count = 0; (count = std::fread(chunk, 1, sizeof chunk, file)) > 0;) {
        bytes.insert(bytes.end(), chunk, chunk + count);
    }
    std::fclose(file);
    return bytes;
}

struct Asset {
    std::vector<std::byte> bytes;
    Blob blob;
};

struct Scene {
    std::vector<std::byte> bytes;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    BakedScene scene;
};

/// Opens the files as scenes, as deformable blobs or as others.
bool read_files(std::span<char*> paths, std::vector<Asset>& assets, std::vector<Asset>& deformables,
                std::vector<Scene>& scenes) {
    for (const char* const path : paths) {
        const std::vector<std::byte> bytes = read_file(path);
        const Blob blob = open(bytes);
        if (blob) {
            Asset& asset = (blob.is_deformable() ? deformables : assets).emplace_back();
            asset.bytes = bytes;
            asset.blob = open(asset.bytes);
            continue;
        }
        Scene& scene = scenes.emplace_back();
        scene.bytes = bytes;
        scene.meshes.resize(mesh_count_of_scene(bytes));
        scene.tiles.resize(tile_count_of_scene(bytes));
        scene.scene = open_scene(scene.bytes, scene.meshes, scene.tiles);
        if (scene.scene) continue;
        const bool is_blob = scene.scene.status() == OpenStatus::not_a_blob;
        std::fprintf(stderr, "%s: %s\n", path, describe(is_blob ? blob.status() : scene.scene.status()));
        return false;
    }
    return true;
}

/// The bytes of things of one kind, and the answers about them.
struct Tally {
    platform::Fingerprint bytes;
    platform::Answers all;

    void add(const platform::Answers& answers) {
        std::fputs(platform::report(answers).c_str(), stdout);
        all.calls += answers.calls;
        all.fingerprint.add(answers.fingerprint);
    }
    void add(const std::vector<std::byte>& file, const platform::Answers& answers) {
        add(answers);
        bytes.add(std::span<const std::byte>(file));
    }
    void print(std::uint32_t questions_of_a_kind, std::size_t count, const char* kind) const {
        const auto things = static_cast<std::uint32_t>(count);
        std::fputs(platform::summary(questions_of_a_kind, things, kind, bytes, all).c_str(), stdout);
    }
};

void answer_scenes(const std::vector<Scene>& scenes, std::uint32_t questions_of_a_kind) {
    Tally tally;
    for (const Scene& scene : scenes) tally.add(scene.bytes, platform::ask_scene(scene.scene, questions_of_a_kind));
    tally.print(questions_of_a_kind, scenes.size(), "scenes");
}

void answer_blobs(const std::vector<Asset>& assets, std::uint32_t questions_of_a_kind, bool with_moving) {
    Tally tally;
    for (const Asset& asset : assets) {
        tally.add(asset.bytes, platform::ask_everything(asset.blob, questions_of_a_kind));
        if (!with_moving) continue;
        std::fputs(platform::report(platform::ask_moving(asset.blob, 40 * questions_of_a_kind)).c_str(), stdout);
    }
    for (std::size_t i = 0; i + 1 < assets.size(); ++i) {
        platform::Questions questions(assets[i].blob);
        for (std::uint32_t number = 0; number < (questions_of_a_kind + 3) / 4; ++number)
            platform::ask_pairs(assets[i].blob, assets[i + 1].blob, questions, number, tally.all);
    }
    tally.print(questions_of_a_kind, assets.size(), "blobs");
}

void answer_deformables(const std::vector<Asset>& assets, std::uint32_t questions_of_a_kind) {
    Tally tally;
    for (const Asset& asset : assets) {
        const platform::Answers answers = platform::ask_in_poses(asset.blob, questions_of_a_kind, tally.bytes);
        tally.add(asset.bytes, answers);
    }
    tally.print(questions_of_a_kind, assets.size(), "deformable blobs");
}

/// Runs 250 calls for each question on a moving scene of the parts of each scene. Every other one has the least memory.
void answer_moving_scenes(const std::vector<Scene>& scenes, std::uint32_t questions_of_a_kind) {
    constexpr std::uint32_t capacity = 400;
    alignas(32) static std::byte memory[68 * 1024];
    Tally tally;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const BakedScene& scene = scenes[i].scene;
        const std::uint64_t bytes = i % 2 == 0 ? moving_scene_bytes(capacity) : least_moving_scene_bytes(capacity);
        std::memset(memory, 0, sizeof memory);
        const platform::MovingParts parts = {scene.meshes(), scene.tiles(), scene};
        platform::Answers answers;
        platform::MovingScript script(parts, std::span(memory).first(static_cast<std::size_t>(bytes)), capacity,
                                      answers, tally.bytes);
        script.run(250 * questions_of_a_kind);
        tally.add(answers);
    }
    tally.print(questions_of_a_kind, scenes.size(), "moving scenes");
}

/// False when this machine, or the build, has no such set.
bool choose_instruction_set(const char* name) {
#if ESPALIER_X86
    using detail::InstructionSet;
    const char* const names[] = {"scalar", "sse42", "avx2", "avx512"};
    for (std::uint8_t set = 0; set <= static_cast<std::uint8_t>(detail::detect_instruction_set()); ++set) {
        if (std::strcmp(name, names[set]) == 0 && detail::is_built(static_cast<InstructionSet>(set))) {
            detail::known_instruction_set = static_cast<std::uint8_t>(set + 1);
            return true;
        }
    }
#endif
    std::fprintf(stderr, "query_answers: this machine has no %s\n", name);
    return false;
}

}  // namespace

int main(int argument_count, char** arguments) {
    std::span<char*> rest(arguments + 1, static_cast<std::size_t>(argument_count - 1));
    if (rest.size() >= 2 && std::strcmp(rest[0], "--set") == 0) {
        if (!choose_instruction_set(rest[1])) return 77;
        rest = rest.subspan(2);
    }
    const bool with_moving = !rest.empty() && std::strcmp(rest[0], "--moving") == 0;
    if (with_moving) rest = rest.subspan(1);
    if (rest.size() < 2) {
        std::fputs("usage: query_answers [--set NAME] [--moving] QUESTIONS BLOB...\n", stderr);
        return 1;
    }
    std::vector<Asset> assets;
    std::vector<Asset> deformables;
    std::vector<Scene> scenes;
    if (!read_files(rest.subspan(1), assets, deformables, scenes)) return 2;
    const auto questions_of_a_kind = static_cast<std::uint32_t>(std::strtoul(rest[0], nullptr, 10));
    if (!scenes.empty()) answer_scenes(scenes, questions_of_a_kind);
    if (!assets.empty()) answer_blobs(assets, questions_of_a_kind, with_moving);
    if (!scenes.empty()) answer_moving_scenes(scenes, questions_of_a_kind);
    if (!deformables.empty()) answer_deformables(deformables, questions_of_a_kind);
    return 0;
}
