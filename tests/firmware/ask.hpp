// Asks what lies in the bytes of a blob: on a core and on this machine, which must print the same line.
#pragma once

#include <cstddef>
#include <span>

#include <espalier/espalier.hpp>

#include "../platform/report.hpp"
#include "moving_workload.hpp"
#include "refit_workload.hpp"
#include "scene_workload.hpp"
#include "workload.hpp"

namespace espalier::firmware {

struct Asked {
    OpenStatus status = OpenStatus::ok;
    platform::Fingerprint answers;
};

/// Every query of a blob, or the usual ones alone: for meshes that leave no room for more code, or take too long.
template <bool every>
inline constexpr auto ask_blob = [](std::span<const std::byte> bytes, const auto& measure) -> Asked {
    const Blob blob = open(bytes);
    if (!blob) return {blob.status(), {}};
    Workload workload(bytes, blob, measure);
    workload.ask_usual({});
    if constexpr (every) workload.ask_others({});
    return {OpenStatus::ok, workload.answers()};
};

// What these need lies on the stack: a core writes nowhere else.
inline constexpr auto ask_scene = [](std::span<const std::byte> bytes, const auto& measure) -> Asked {
    Blob meshes[4];
    const BakedScene scene = open_scene(bytes, meshes);
    if (!scene) return {scene.status(), {}};
    SceneWorkload workload(bytes, std::span(meshes), scene, measure);
    workload.ask(Counts{}.usual);
    return {OpenStatus::ok, workload.answers()};
};

inline constexpr auto ask_moving = [](std::span<const std::byte> bytes, const auto& measure) -> Asked {
    const Blob cube = open(bytes);
    if (!cube) return {cube.status(), {}};
    alignas(32) std::byte block[mover_block_bytes];
    MovingWorkload workload(block, cube, measure);
    workload.ask(Counts{}.steps);
    return {OpenStatus::ok, workload.answers()};
};

inline constexpr auto ask_refit = [](std::span<const std::byte> bytes, const auto& measure) -> Asked {
    const Blob cloth = open(bytes);
    if (!cloth) return {cloth.status(), {}};
    std::byte memory[most_cloth_bytes];
    Vec3 positions[ClothPlaces::count];
    if (deformable_bytes(cloth) > sizeof memory) return {OpenStatus::not_opened, {}};
    RefitWorkload workload(memory, positions, cloth, measure);
    workload.ask(Counts{}.poses);
    return {OpenStatus::ok, workload.answers()};
};

/// The line that every machine must print alike.
inline platform::Line workload_line(const platform::Fingerprint& answers) {
    platform::Line line;
    line.add("workload ", answers, "\n");
    return line;
}

}  // namespace espalier::firmware
