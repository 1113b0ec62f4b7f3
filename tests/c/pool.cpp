#include "pool.hpp"

namespace espalier::tests {

namespace {

espalier_vec3 c(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

void Pool::fill(const question& from, const Lattice& common) {
    bits = from.bits;
    const auto point = [&](std::size_t i) { return c(from.points[i % 4]); };
    const auto way = [&](std::size_t i) { return c(from.directions[i % 4]); };
    const float* const lengths = from.lengths;
    for (std::uint32_t i = 0; i < slots; ++i) {
        vec3[i] = i % 2 == 0 ? point(i / 2) : way(i / 2);
        number[i] = lengths[i % 4];
        plane[i] = {way(i), lengths[i % 4]};
        original_triangle[i] = {bits, 1, i, bits % (2 + i % 3)};
    }

    segment[0] = {point(0), point(1)};
    sphere[0] = {point(0), lengths[0]};
    capsule[0] = {point(1), point(2), lengths[1]};
    box[0] = {point(0), point(3)};
    oriented_box[0] = {point(1), {way(0), way(1), way(2)}};
    cone[0] = {point(2), way(0), lengths[2]};
    triangle[0] = {point(0), point(1), point(2)};
    convex_volume[0] = {plane, bits % 5};
    for (std::size_t i = 0; i < std::size(hull_vertices_); ++i) hull_vertices_[i] = point(i);
    convex_hull[0] = {hull_vertices_, bits % 5};
    for (std::size_t i = 0; i < slots; ++i) {
        const std::size_t kind = (bits + i) % 3;
        ray[i] = kind == 0 ? espalier_ray_between(point(i), point(i + 1)) : espalier_default_ray(point(i), way(0));
        if (kind != 1) continue;
        ray[i].t_min = lengths[0];
        ray[i].t_max = lengths[1];
        ray[i].culling = static_cast<std::uint8_t>(bits >> 5 & 3);  // one value more than there are
    }

    const float* const q = from.rotation;
    const float scale = bits % 5 == 0 ? lengths[0] : 0.5f + static_cast<float>(bits % 8) / 8.0f;
    const espalier_transform turned = {{q[0], q[1], q[2], q[3]}, point(3), scale};
    const espalier_transform moved = {{0, 0, 0, 1}, way(0), 1}, whole = {{0, 0, 0, 1}, {64, 0, -128}, 1};
    const espalier_transform kinds[] = {espalier_identity(), turned, whole, moved};
    const float scaled[] = {0, -2, 0, 5, 2, 0, 0, 6, 0, 0, 2, 7};
    if ((bits & 128) == 0) std::copy_n(scaled, 12, rows);
    else std::memcpy(rows, from.points, sizeof rows);
    transform[0] = kinds[bits >> 7 & 3];
    transform[1] = moved;
    for (std::size_t i = 0; i < 2; ++i) placed_blob[i] = {&blob[i], transform[i]};
    work_limit = bits % 3 == 0 ? bits % 30 : bits % 8 == 1 ? bits % 900 : 300;

    const std::uint32_t triangles = to<Blob>(&blob[0]).triangle_count();
    for (std::uint32_t i = 0; i < slots; ++i)
        triangle_id[i] = i % 4 == 3 ? ESPALIER_NO_TRIANGLE : i % 4 == 2 ? bits : (bits >> i % 16) % (triangles + 1);
    if (bits >> 30 == 0) triangle_id[0] = bits;
    lattice[0] = std::bit_cast<espalier_lattice>(to<Blob>(&blob[0]).lattice());
    const auto steps = [&](const Vec3& at) {
        return std::bit_cast<espalier_lattice_point>(*to_lattice(to<Blob>(&blob[0]).lattice(), at));
    };
    lattice_point[0] = steps(from.points[0]);
    lattice_segment[0] = {steps(from.points[2]), steps(from.points[3])};
    lattice_box[0] = {steps(from.points[0]), steps(from.points[3])};
    rounded_ray[0] = std::bit_cast<espalier_rounded_ray>(round_ray(common, to<Ray>(&ray[0])));

    strided_vec3[0] = {vec3, 24};
    strided_float[0] = {number, 4};
    strided_triangle_id[0] = {triangle_id, 8};
    ray_arrays[0] = {strided_vec3[0], {vec3 + slots - 1, -24}, {}, {}, static_cast<std::uint8_t>(bits >> 2 & 3)};
    if ((bits & 1) != 0) ray_arrays[0].t_max = strided_float[0];
    if ((bits & 2) != 0) ray_arrays[0].t_min = {&number[3], 0};
    sphere_arrays[0] = {strided_vec3[0], strided_float[0]};
    box_arrays[0] = {{vec3, 0}, strided_vec3[0]};
    capacity = nothing ? 0 : bits >> 8 & 7;
    if (!nothing && capacity == 7) capacity = slots;
    count = nothing ? 0 : std::size_t{1} << (bits >> 11 & 3);
    if (count == 8) count = 18;  // a group and two
    places = nothing ? 0 : bits % 3;

    mask = bits % 3 == 0 ? 0xFFFFFFFF : bits % 3 == 1 ? bits % 16 : bits >> 4;
    mesh = bits >> 28 == 0 ? bits : (bits >> 4) % 7;
    slot = bits >> 28 == 0 ? bits : (bits >> 4) % 50;
    byte = static_cast<std::uint8_t>(bits >> 13 & (bits >> 30 == 0 ? 255 : 31));
    yes_no[0] = {byte};
    sweep_options[0] = {(bits & 4) != 0 ? callback<espalier_triangle_filter>() : nullptr,
                        this,
                        lengths[1],
                        static_cast<std::uint8_t>(bits & 3),
                        (bits & 8) != 0,
                        {}};
    scene_sweep_options[0] = {(bits & 4) != 0 ? callback<espalier_scene_filter>() : nullptr,
                              this,
                              lengths[1],
                              static_cast<std::uint8_t>(bits & 3),
                              (bits & 8) != 0,
                              {}};
    pair_filter[0] = {(bits & 1) != 0, (bits & 2) != 0 ? callback<espalier_pair_keep>() : nullptr, this};

    const MovingScene& moving = to<MovingScene>(&moving_scene[0]);
    const std::uint32_t instances = 1 + std::max(to<BakedScene>(&scene[0]).instance_count(), moving.slot_end());
    instance_id[0] = {bits >> 28 == 0 ? bits : bits % instances, bits >> 9 & 1 ? bits >> 10 & 3 : ESPALIER_NO_INSTANCE};
    for (std::uint32_t i = 0; i < slots; ++i) {
        instance[i] = {turned, (bits >> i % 24) % 7, bits >> 8, bits, 7};
        const InstanceHandle handle = *handle_of(moving, (bits >> i % 24) % (moving.slot_end() + 1));
        movement[i] = {{handle.slot, handle.generation}, turned};
        movement[i].transform.translation = point(i);
    }
    instance_handle[0] = bits >> 29 == 0 ? espalier_instance_handle{bits % 50, bits >> 20 & 3} : movement[0].instance;
    visits_ = bits % 9;
}

void Pool::start_page() {
    visits_left_ = visits_;
    const bool anywhere = bits >> 29 == 0;
    cursor[slots - 1] = anywhere ? espalier_cursor{{bits, bits % 3, bits >> 4}} : espalier_cursor{};
    instance_pair[slots - 1] = anywhere ? espalier_instance_pair{bits % 40, bits >> 8} : espalier_instance_pair{};
    baked_pair[slots - 1] = anywhere ? espalier_baked_pair{bits % 40, {bits >> 8, bits}} : espalier_baked_pair{};
}

void Pool::spoil(Random random) {
    const auto any = [&]<class... T>(T&... arguments) { ((arguments = any_bits<T>(random)), ...); };
    any(segment[0], sphere[0], capsule[0], box[0], oriented_box[0], cone[0], triangle[0], ray[0], transform[0],
        lattice[0]);
    any(lattice_point[0], lattice_segment[0], lattice_box[0], ray_hit[0], pair_contact[0], pair_touch[0]);
    any(original_triangle[0], original_triangle[1], contact[0], contact[1], instance_id[0], instance[0],
        instance_handle[0]);
    any(movement[0], number[0], triangle_id[0], bits, mask, mesh, slot, work_limit);
    const auto words = any_bits<espalier_rounded_ray>(random);
    for (std::uint32_t i = 0, one_in = 1 + random.below(30); i < std::size(words.opaque_); ++i)
        if (random.below(one_in) == 0) rounded_ray[0].opaque_[i] = words.opaque_[i];
    const std::uint32_t triangles = to<Blob>(&blob[0]).triangle_count();
    if (random.coin()) ray_hit[0].triangle = random.below(triangles + 2);
    byte = static_cast<std::uint8_t>(bits);
    yes_no[0] = {byte};
    if (random.coin()) lattice[0].step_exponent = static_cast<std::int32_t>(random.below(220)) - 110;
    convex_volume[0].plane_count = random.below(8) == 0 ? SIZE_MAX : random.below(slots + 1);
    convex_hull[0].vertex_count =
        random.below(8) == 0 ? SIZE_MAX : random.below(static_cast<std::uint32_t>(std::size(hull_vertices_)) + 1);
    for (std::byte& one : input) one = static_cast<std::byte>(random.next());
}

}  // namespace espalier::tests
