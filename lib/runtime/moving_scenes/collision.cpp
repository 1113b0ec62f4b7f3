#include <runtime/moving_scenes/collision.hpp>

#include <espalier/scene.hpp>
#include <runtime/moving_scenes/box_tree/steps_box.hpp>
#include <runtime/pairs/contacts.hpp>

namespace espalier::detail {

namespace {

/// Returns out_of_range for a transform into a tile that no floats hold: those of instances are valid.
QueryStatus find_collision_of_meshes(const Blob& a, const Transform& at_a, const Blob& b, const Transform& at_b,
                                     PairWork& work) {
    const QueryStatus status = find_first_contact(PlacedBlob(a, at_a), PlacedBlob(b, at_b), work).status;
    return status == QueryStatus::invalid_argument ? QueryStatus::out_of_range : status;
}

/// Calls `collide(mesh, transform)` for each mesh of a tile whose box touches a box in its local space, until one
/// collides or the work is done. Returns the last status.
template <class Collide>
QueryStatus for_each_mesh_near(const BakedScene& tile, const Box& box, Collide collide) {
    QueryStatus status = QueryStatus::not_found;
    const QueryStatus end = for_each_candidate(tile, box, [&](InstanceId id) {
        const std::byte* const record = record_of(data_of(tile), id);
        status = collide(*part_of(data_of(tile), record).mesh, transform_of(record));
        return status == QueryStatus::not_found ? Visit::next : Visit::stop;
    });
    return is_refused(end) ? QueryStatus::out_of_range : status;
}

QueryStatus find_collision_with_tile(const Blob& mesh, const Transform& at_mesh, const BakedScene& tile,
                                     const Transform& at_tile, PairWork& work) {
    const Transform in_tile = to_local(at_tile, at_mesh);
    return for_each_mesh_near(tile, box_around(bounds_of(data_of(mesh)), in_tile),
                              [&](const Blob& other, const Transform& at_other) {
                                  return find_collision_of_meshes(mesh, in_tile, other, at_other, work);
                              });
}

QueryStatus find_collision_of_tiles(const BakedScene& a, const Transform& at_a, const BakedScene& b,
                                    const Transform& at_b, PairWork& work) {
    const Transform in_a = to_local(at_a, at_b);
    return for_each_mesh_near(a, box_around(bounds_of(b), in_a), [&](const Blob& mesh, const Transform& at_mesh) {
        return find_collision_with_tile(mesh, at_mesh, b, in_a, work);
    });
}

}  // namespace

QueryStatus find_collision(const PlacedPart& a, const PlacedPart& b, PairWork& work) {
    if (a.part.mesh == nullptr && b.part.mesh == nullptr)
        return find_collision_of_tiles(*a.part.tile, a.transform, *b.part.tile, b.transform, work);
    if (a.part.mesh == nullptr)
        return find_collision_with_tile(*b.part.mesh, b.transform, *a.part.tile, a.transform, work);
    if (b.part.mesh == nullptr)
        return find_collision_with_tile(*a.part.mesh, a.transform, *b.part.tile, b.transform, work);
    return find_collision_of_meshes(*a.part.mesh, a.transform, *b.part.mesh, b.transform, work);
}

}  // namespace espalier::detail
