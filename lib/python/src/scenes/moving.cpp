// Scenes whose instances come, move and go. Each call takes a whole batch of them.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "floats.hpp"
#include "lists.hpp"
#include "scenes/held_moving.hpp"
#include "scenes/instances.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include <espalier/scenes/moving_scene.hpp>

namespace espalier::python {

namespace {

static_assert(sizeof(InstanceHandle) == 8);

/// Returns the meshes and tiles that the instances of a scene place, without memory for these.
std::shared_ptr<MovingBlock> hold_parts(const py::list& meshes, const py::list& tiles) {
    auto self = std::make_shared<MovingBlock>();
    for (const py::handle mesh : meshes) {
        self->meshes.push_back(mesh.cast<const HeldBlob&>().blob);
        self->mesh_owners.push_back(py::reinterpret_borrow<py::object>(mesh));
    }
    for (const py::handle tile : tiles) {
        self->tiles.push_back(tile.cast<const HeldScene&>().scene);
        self->tile_owners.push_back(py::reinterpret_borrow<py::object>(tile));
    }
    return self;
}

/// Returns memory for instances, whose bytes are not set.
std::span<std::byte> allocate(MovingBlock& self, std::size_t size) {
    self.memory.reset(static_cast<std::byte*>(::operator new (size, std::align_val_t{32})));
    return {self.memory.get(), size};
}

std::unique_ptr<HeldMovingScene> create(const py::list& meshes, const py::list& tiles, std::uint32_t capacity,
                                        int step_exponent) {
    auto block = hold_parts(meshes, tiles);
    const auto size = static_cast<std::size_t>(moving_scene_bytes(capacity));
    if (size == 0) throw py::value_error("capacity must be from 1 to 16777216");
    MovingScene scene;
    {
        const py::gil_scoped_release unlocked;
        const std::span<std::byte> memory = allocate(*block, size);
        scene = create_moving_scene(memory, capacity, step_exponent, block->meshes, block->tiles);
    }
    if (!scene) throw py::value_error("step_exponent must be from -100 to 80");
    return std::make_unique<HeldMovingScene>(std::move(block), scene);
}

std::unique_ptr<HeldMovingScene> open(const py::bytes& snapshot, const py::list& meshes, const py::list& tiles) {
    auto block = hold_parts(meshes, tiles);
    const std::string_view bytes = snapshot;
    const std::span<std::byte> memory = allocate(*block, std::max<std::size_t>(bytes.size(), 1));
    std::memcpy(memory.data(), bytes.data(), bytes.size());
    MovingScene scene;
    {
        const py::gil_scoped_release unlocked;
        scene = open_moving_scene(memory.first(bytes.size()), block->meshes, block->tiles);
    }
    if (!scene) throw py::value_error("the bytes are no snapshot of a moving scene with these meshes and tiles");
    return std::make_unique<HeldMovingScene>(std::move(block), scene);
}

/// Returns a view of the same block from a place in the world.
std::unique_ptr<HeldMovingScene> view_from(const HeldMovingScene& self, double x, double y, double z) {
    const MovingScene seen = seen_from(self.scene, {x, y, z});
    if (!seen) throw py::value_error("place must be finite and less than 2^30 - 64 steps from 0 on each axis");
    return std::make_unique<HeldMovingScene>(self.block, seen);
}

py::tuple origin_of_view(const HeldMovingScene& self) {
    const Vec3d origin = self.scene.origin();
    return py::make_tuple(origin.x, origin.y, origin.z);
}

py::bytes snapshot(const HeldMovingScene& self) {
    const std::vector<std::byte> bytes = shared(self, [&] {
        const std::span<const std::byte> all = self.scene.bytes();
        return std::vector(all.begin(), all.end());
    });
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Returns a handle and a status for each instance.
py::array insert_all(HeldMovingScene& self, const py::handle& places, const GivenInstances::Numbers& numbers) {
    const GivenInstances instances(places, numbers, origin_of(self));
    py::array results = instances.batch.results(dtype_of("handle"));
    auto* out = static_cast<Result<InstanceHandle>*>(results.mutable_data());
    alone(self, [&] {
        for (std::size_t i = 0; i < instances.batch.count(); ++i) out[i] = insert(self.scene, instances.at(i));
    });
    return results;
}

/// The handles of a batch: an array whose last axis is a slot and a generation.
class Handles {
public:
    using Array = py::array_t<std::uint32_t, py::array::c_style>;

    explicit Handles(const Array& given) : array_(given), shape_(shape_of(given)) {
        if (shape_.empty() || shape_.back() != 2) throw py::value_error("a handle has a slot and a generation");
        shape_.pop_back();
    }
    [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(array_.size()) / 2; }
    [[nodiscard]] InstanceHandle at(std::size_t i) const { return {array_.data()[2 * i], array_.data()[2 * i + 1]}; }
    /// Returns an array for a status of each.
    [[nodiscard]] py::array statuses() const { return py::array(py::dtype::of<std::uint8_t>(), shape_); }

private:
    Array array_;
    std::vector<py::ssize_t> shape_;
};

/// Calls change(scene, handle, value) with each handle and the 32 bits of it, and returns the statuses.
template <class Change>
py::array change_each(HeldMovingScene& self, const Handles& handles, const std::uint32_t* values,
                      const Change& change) {
    py::array statuses = handles.statuses();
    auto* out = static_cast<QueryStatus*>(statuses.mutable_data());
    alone(self, [&] {
        for (std::size_t i = 0; i < handles.count(); ++i)
            out[i] = change(self.scene, handles.at(i), values == nullptr ? 0 : values[i]);
    });
    return statuses;
}

py::array remove_all(HeldMovingScene& self, const Handles::Array& given) {
    return change_each(self, Handles(given), nullptr,
                       [](MovingScene& scene, InstanceHandle handle, std::uint32_t) { return remove(scene, handle); });
}

/// Returns the box of each instance in the tree.
py::array boxes_of(const HeldMovingScene& self, const Handles::Array& given) {
    const Handles handles(given);
    py::array results(dtype_of("box"), shape_of(handles.statuses()));
    auto* out = static_cast<Result<Box>*>(results.mutable_data());
    shared(self, [&] {
        for (std::size_t i = 0; i < handles.count(); ++i) out[i] = box_of(self.scene, handles.at(i));
    });
    return results;
}

/// Returns whether rays are rounded once for each instance and others; false for a handle that is stale.
py::array on_common_lattice(const HeldMovingScene& self, const Handles::Array& given) {
    const Handles handles(given);
    py::array results(py::dtype::of<bool>(), shape_of(handles.statuses()));
    auto* out = static_cast<bool*>(results.mutable_data());
    shared(self, [&] {
        for (std::size_t i = 0; i < handles.count(); ++i) {
            const InstanceHandle handle = handles.at(i);
            out[i] = box_of(self.scene, handle) && is_on_common_lattice(self.scene, InstanceId{handle.slot}).yes();
        }
    });
    return results;
}

using Words = py::array_t<std::uint32_t, py::array::c_style>;

/// Sets the mask or the user's number of each instance.
py::array set_words(HeldMovingScene& self, const Handles::Array& given, const Words& words, bool is_mask) {
    const Handles handles(given);
    if (static_cast<std::size_t>(words.size()) != handles.count())
        throw py::value_error("there must be a number for each handle");
    return change_each(self, handles, words.data(), is_mask ? set_mask : set_user);
}

/// Moves instances as one batch, which goes on behind those that are refused, and renews the tree once.
py::array move_all(HeldMovingScene& self, const Handles::Array& given, const py::handle& given_places) {
    const Handles handles(given);
    Floats places(given_places, "places", {8}, origin_of(self));
    const Batch batch({&places});
    if (batch.count() != handles.count()) throw py::value_error("there must be a place for each handle");
    py::array statuses = handles.statuses();
    auto* out = static_cast<QueryStatus*>(statuses.mutable_data());
    alone(self, [&] {
        std::vector<Movement> movements(handles.count());
        for (std::size_t i = 0; i < movements.size(); ++i) movements[i] = {handles.at(i), places.as<Transform>().at(i)};
        std::fill_n(out, movements.size(), QueryStatus::ok);
        for (std::size_t begin = 0; begin < movements.size();) {
            const Filled moved = move(self.scene, std::span(movements).subspan(begin));
            begin += moved.count;
            if (moved.status != QueryStatus::ok) out[begin++] = moved.status;
        }
        refit(self.scene);
    });
    return statuses;
}

/// Gives all instances of a mesh another blob. Returns the status; a refusal changes nothing.
int set_mesh(HeldMovingScene& self, std::size_t mesh, const py::object& given) {
    MovingBlock& block = *self.block;
    const HeldBlob& blob = given.cast<const HeldBlob&>();
    if (mesh >= block.meshes.size()) throw py::index_error("the scene has no such mesh");
    if (blob.blob.triangle_count() == 0) throw py::value_error("the blob has no triangles");
    py::object owner = given;
    const QueryStatus status = alone(self, [&] {
        const Blob old = block.meshes[mesh];
        block.meshes[mesh] = blob.blob;
        const QueryStatus moved = move_instances_of(self.scene, static_cast<std::uint32_t>(mesh));
        if (moved == QueryStatus::ok) {
            std::swap(block.mesh_owners[mesh].ptr(), owner.ptr());  // counts no references
            // The slack of queries follows from the lattices, and a repack computes it anew.
            if (old.lattice() == blob.blob.lattice()) refit(self.scene);
            else repack(self.scene);
        } else {
            block.meshes[mesh] = old;
        }
        return moved;
    });
    return static_cast<int>(status);
}

/// Calls at(slot) for all slots that were ever used.
template <class Value, class At>
py::array for_slots(const HeldMovingScene& self, const char* type, const At& at) {
    Growing<Value> values;
    shared(self, [&] {
        for (std::uint32_t slot = 0; slot < self.scene.slot_end(); ++slot) values.push(at(slot));
    });
    return values.to_numpy(dtype_of(type));
}

py::array handles(const HeldMovingScene& self) {
    return for_slots<Result<InstanceHandle>>(self, "handle",
                                             [&](std::uint32_t slot) { return handle_of(self.scene, slot); });
}

py::array instances(const HeldMovingScene& self) {
    return for_slots<Instance>(self, "instance", [&](std::uint32_t slot) {
        const Result<Instance> instance = instance_at(self.scene, InstanceId{slot});
        if (instance) return *instance;
        Instance free;
        free.mesh = free.source = no_instance.index;
        free.mask = 0;
        return free;
    });
}

py::dict facts(const HeldMovingScene& self) {
    const auto [count, end] =
        shared(self, [&] { return std::pair(self.scene.instance_count(), self.scene.slot_end()); });
    py::dict facts;
    facts["instance_count"] = count;
    facts["capacity"] = self.scene.capacity();
    facts["slot_end"] = end;
    facts["step_exponent"] = self.scene.step_exponent();
    return facts;
}

float quality_of(const HeldMovingScene& self) {
    return shared(self, [&] { return quality(self.scene); });
}

}  // namespace

void bind_moving_scenes(py::module_& module) {
    py::class_<HeldMovingScene>(module, "MovingScene")
        .def("facts", facts)
        .def("seen_from", view_from)
        .def("origin", origin_of_view)
        .def("quality", quality_of)
        .def("handles", handles)
        .def("instances", instances)
        .def("snapshot", snapshot)
        .def("insert", insert_all)
        .def("remove", remove_all)
        .def("move", move_all)
        .def("set_words", set_words)
        .def("boxes", boxes_of)
        .def("on_common_lattice", on_common_lattice)
        .def("set_mesh", set_mesh)
        .def("repack", [](HeldMovingScene& self) { alone(self, [&] { repack(self.scene); }); })
        .def("end_step", [](HeldMovingScene& self) { alone(self, [&] { end_step(self.scene); }); });
    module.def("create_moving_scene", create);
    module.def("open_moving_scene", open);
}

}  // namespace espalier::python
