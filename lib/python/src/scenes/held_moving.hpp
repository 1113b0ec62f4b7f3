// Moving scenes with their blocks, and the locks that queries and changes of them take.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <shared_mutex>
#include <variant>
#include <vector>

#include <pybind11/pybind11.h>

#include <espalier/scenes/moving_scene.hpp>

#include "held_blob.hpp"

namespace espalier::python {

/// A moving scene as Python holds it.
struct HeldMovingScene {
    struct Free {
        void operator()(std::byte* bytes) const { ::operator delete (bytes, std::align_val_t{32}); }
    };

    std::vector<py::object> mesh_owners;  // each keeps the bytes of a mesh
    std::vector<py::object> tile_owners;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    std::unique_ptr<std::byte, Free> memory;
    MovingScene scene;
    mutable std::shared_mutex mutex;  // shared by queries, and held alone by changes
};

/// Returns what a query of a scene holds while it reads: nothing, since a baked scene never changes.
inline std::monostate reading(const HeldScene&) { return {}; }
/// Returns a lock that keeps the scene as it is. Waits without Python's lock: the thread that it waits for may need it.
inline std::shared_lock<std::shared_mutex> reading(const HeldMovingScene& self) {
    const py::gil_scoped_release unlocked;
    return std::shared_lock(self.mutex);
}

/// Calls change() while no other thread reads or changes the scene, without Python's lock.
template <class Change>
auto alone(HeldMovingScene& self, const Change& change) {
    const py::gil_scoped_release unlocked;
    const std::unique_lock lock(self.mutex);
    return change();
}

}  // namespace espalier::python
