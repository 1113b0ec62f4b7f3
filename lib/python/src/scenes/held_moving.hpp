// Moving scenes with their blocks, and the locks that queries and changes of them take.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <shared_mutex>
#include <vector>

#include <pybind11/pybind11.h>

#include <espalier/scenes/moving_scene.hpp>

#include "floats.hpp"
#include "held_blob.hpp"
#include "parts.hpp"

namespace espalier::python {

/// The block of a moving scene and its parts, which all views of it share.
struct MovingBlock {
    struct Free {
        void operator()(std::byte* bytes) const { ::operator delete (bytes, std::align_val_t{32}); }
    };

    std::vector<py::object> mesh_owners;  // each keeps the bytes of a mesh
    std::vector<py::object> tile_owners;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    std::unique_ptr<std::byte, Free> memory;
    std::shared_mutex mutex;  // shared by queries, and held alone by changes
    std::mutex gate;          // held by who waits, so that queries do not pass a change that waits
};

/// A view of a moving scene as Python holds it.
struct HeldMovingScene {
    std::shared_ptr<MovingBlock> block;
    MovingScene scene;
};

/// Returns where the places of a scene count from in float64.
inline Origin origin_of(const HeldScene& self) { return origin_of(self.scene.source_origin()); }
inline Origin origin_of(const HeldMovingScene& self) { return origin_of(self.scene.origin()); }

/// Returns how to keep a scene as it is during a query: a baked scene never changes.
inline WithoutLock reading(const HeldScene&) { return {}; }
/// Returns what returns a lock that keeps the scene as it is. Call that without Python's lock, and make no Python
/// objects while it is held.
inline auto reading(const HeldMovingScene& self) {
    return [&self] {
        const std::lock_guard first(self.block->gate);
        return std::shared_lock(self.block->mutex);
    };
}

/// Calls read() while no thread changes the scene, without Python's lock.
template <class Read>
auto shared(const HeldMovingScene& self, const Read& read) {
    const py::gil_scoped_release unlocked;
    const auto lock = reading(self)();
    return read();
}

/// Calls change() while no other thread reads or changes the scene, without Python's lock.
template <class Change>
auto alone(HeldMovingScene& self, const Change& change) {
    const py::gil_scoped_release unlocked;
    const std::lock_guard first(self.block->gate);
    const std::unique_lock lock(self.block->mutex);
    return change();
}

}  // namespace espalier::python
