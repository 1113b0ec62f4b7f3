// The layouts of the structures of C that the package reads and writes: the names and places of their fields, for
// instance.js, so that JavaScript repeats none of them.
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>

#include <espalier/c/approximate.h>
#include <espalier/c/bake.h>
#include <espalier/c/batches/arrays.h>
#include <espalier/c/batches/rays.h>
#include <espalier/c/blob.h>
#include <espalier/c/bounds.h>
#include <espalier/c/contact.h>
#include <espalier/c/deformation.h>
#include <espalier/c/distance.h>
#include <espalier/c/original.h>
#include <espalier/c/pair.h>
#include <espalier/c/ray.h>
#include <espalier/c/scene.h>
#include <espalier/c/scenes/moving_scene.h>
#include <espalier/c/scenes/pairs.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/sweep.h>
#include <espalier/c/transform.h>
#include <espalier/c/walk.h>

#include "flags.hpp"
#include "scene_records.hpp"

namespace {

/// Numbers of one kind in a row. Kinds: b, h, w and q are unsigned, of 1, 2, 4 and 8 bytes; i has a sign and 4 bytes;
/// f and d are floats of 4 and 8 bytes.
struct Numbers {
    std::uint32_t kind;
    std::uint32_t count;
};

template <class Field>
constexpr Numbers numbers_of() {
    if constexpr (std::is_array_v<Field>) {
        constexpr Numbers one = numbers_of<std::remove_extent_t<Field>>();
        return {one.kind, one.count * std::extent_v<Field>};
    } else if constexpr (std::is_same_v<Field, float>) {
        return {'f', 1};
    } else if constexpr (std::is_same_v<Field, double>) {
        return {'d', 1};
    } else if constexpr (std::is_same_v<Field, espalier_vec3>) {
        return {'f', 3};
    } else if constexpr (std::is_same_v<Field, espalier_vec3d>) {
        return {'d', 3};
    } else if constexpr (std::is_same_v<Field, espalier_quaternion>) {
        return {'f', 4};
    } else if constexpr (std::is_same_v<Field, espalier_triangle>) {
        return {'f', 9};
    } else if constexpr (std::is_pointer_v<Field>) {
        return {'w', 1};
    } else if constexpr (std::is_signed_v<Field>) {
        static_assert(sizeof(Field) == 4);
        return {'i', 1};
    } else {
        static_assert(std::is_unsigned_v<Field>);
        return {sizeof(Field) == 1 ? 'b' : sizeof(Field) == 2 ? 'h' : sizeof(Field) == 4 ? 'w' : 'q', 1};
    }
}

struct Field {
    const char* name;
    std::uint32_t offset;
    Numbers numbers;
};

template <class Type>
constexpr Field field(const char* name, std::size_t offset) {
    return {name, static_cast<std::uint32_t>(offset), numbers_of<Type>()};
}

struct Record {
    const char* name;
    std::uint32_t bytes;
    std::uint32_t field_count;
    const Field* fields;
};

// Defines the table of a structure from its fields.
#define RECORD(structure, ...)                           \
    struct structure##_table {                           \
        using Structure = espalier_##structure;          \
        static constexpr const char* name = #structure;  \
        static constexpr Field fields[] = {__VA_ARGS__}; \
    };
#define FIELD(path) field<decltype(Structure::path)>(#path, offsetof(Structure, path))
// A field under another name than that of its path.
#define FIELD_AS(name, path) field<decltype(Structure::path)>(name, offsetof(Structure, path))
// The fields of an id of an instance.
#define INSTANCE FIELD_AS("instance", instance.index), FIELD_AS("in_tile", instance.in_tile)
// The fields of a handle.
#define HANDLE FIELD_AS("slot", instance.slot), FIELD_AS("generation", instance.generation)
#define HIT(name) FIELD_AS(#name, hit.name)
#define FINDING(name) FIELD(name.count), FIELD(name.first)

RECORD(blob, FIELD(opaque_))
RECORD(vec3d, FIELD(x), FIELD(y), FIELD(z))
RECORD(filled, FIELD(count), FIELD(status))
RECORD(filled_lists, FIELD(lists), FIELD(count), FIELD(needed), FIELD(status))
RECORD(strided_vec3, FIELD(first), FIELD(stride))
RECORD(ray_arrays, FIELD(origins.first), FIELD(origins.stride), FIELD(directions.first), FIELD(directions.stride),
       FIELD(t_min.first), FIELD(t_min.stride), FIELD(t_max.first), FIELD(t_max.stride), FIELD(culling))
RECORD(ray_hit, FIELD(t), FIELD(u), FIELD(v), FIELD(normal), FIELD(triangle), FIELD(status), FIELD(side))
RECORD(closest_point_result, FIELD(point), FIELD(on_shape), FIELD(face_normal), FIELD(distance), FIELD(u), FIELD(v),
       FIELD(triangle), FIELD(status), FIELD(feature), FIELD(side))
RECORD(float_result, FIELD(value), FIELD(status))
RECORD(distance_bounds_result, FIELD_AS("lower", value.lower), FIELD_AS("upper", value.upper), FIELD(status))
RECORD(edge_kinds_result, FIELD_AS("ab", value.ab), FIELD_AS("bc", value.bc), FIELD_AS("ca", value.ca), FIELD(status))
RECORD(sphere_result, FIELD_AS("center", value.center), FIELD_AS("radius", value.radius), FIELD(status))
RECORD(oriented_box_result, FIELD_AS("center", value.center), FIELD_AS("half_axes", value.half_axes), FIELD(status))
RECORD(k_dop_result, FIELD_AS("low", value.lo), FIELD_AS("high", value.hi), FIELD(status))
RECORD(box_result, FIELD_AS("min", value.min), FIELD_AS("max", value.max), FIELD(status))
RECORD(deformable, FIELD(opaque_))
RECORD(refit_result, FIELD(status), FIELD(position), FIELD(quality))
RECORD(scene_candidate, INSTANCE)
RECORD(scene_contact, HIT(point), HIT(normal), HIT(distance), HIT(triangle), HIT(feature), HIT(side), INSTANCE)
RECORD(sweep_hit, FIELD(t), FIELD(point), FIELD(normal), FIELD(face_normal), FIELD(triangle), FIELD(status),
       FIELD(feature), FIELD(starts_overlapping))
RECORD(sweep_options, FIELD(skin), FIELD(culling), FIELD(ignore_leaving))
RECORD(original_triangle, FIELD(file), FIELD(mesh), FIELD(triangle), FIELD(first_corner))
RECORD(original_triangle_result, FIELD(value.file), FIELD(value.mesh), FIELD(value.triangle), FIELD(value.first_corner),
       FIELD(status))
RECORD(original_hit, FIELD(file), FIELD(mesh), FIELD(triangle), FIELD(u), FIELD(v), FIELD(status))
RECORD(triangle_result, FIELD(value), FIELD(status))
RECORD(sphere, FIELD(center), FIELD(radius))
RECORD(capsule, FIELD(from), FIELD(to), FIELD(radius))
RECORD(box, FIELD(min), FIELD(max))
RECORD(oriented_box, FIELD(center), FIELD(half_axes))
RECORD(cone, FIELD(apex), FIELD(axis), FIELD(radius))
RECORD(convex_hull, FIELD(vertices), FIELD(vertex_count))
RECORD(convex_volume, FIELD(planes), FIELD(plane_count))
RECORD(triangle, FIELD(a), FIELD(b), FIELD(c))
RECORD(segment, FIELD(from), FIELD(to))
RECORD(contact, FIELD(point), FIELD(normal), FIELD(distance), FIELD(triangle), FIELD(feature), FIELD(side))
RECORD(contact_plane, FIELD(normal), FIELD(distance), FIELD(triangle))
RECORD(vec3_result, FIELD(value), FIELD(status))
RECORD(transform, FIELD(rotation), FIELD(translation), FIELD(scale))
RECORD(pair_contact, FIELD(a), FIELD(b), FIELD(status))
RECORD(pair_touch, FIELD(points), FIELD(normal), FIELD(depth), FIELD(a), FIELD(b), FIELD(count), FIELD(status))
RECORD(blob_distance, FIELD(distance), FIELD(on_a), FIELD(on_b), FIELD(a), FIELD(b), FIELD(status))
RECORD(scene, FIELD(opaque_))
RECORD(instance, FIELD_AS("rotation", transform.rotation), FIELD_AS("translation", transform.translation),
       FIELD_AS("scale", transform.scale), FIELD(mesh), FIELD(mask), FIELD(user), FIELD(source))
RECORD(ray, FIELD(origin), FIELD(direction), FIELD(t_min), FIELD(t_max), FIELD(culling))
RECORD(scene_ray_hit, HIT(t), HIT(u), HIT(v), HIT(normal), HIT(triangle), HIT(status), HIT(side), INSTANCE)
RECORD(scene_closest_point_result, HIT(point), HIT(on_shape), HIT(face_normal), HIT(distance), HIT(u), HIT(v),
       HIT(triangle), HIT(status), HIT(feature), HIT(side), INSTANCE)
RECORD(scene_sweep_hit, HIT(t), HIT(point), HIT(normal), HIT(face_normal), HIT(triangle), HIT(status), HIT(feature),
       HIT(starts_overlapping), INSTANCE)
RECORD(scene_sweep_options, FIELD(skin), FIELD(culling), FIELD(ignore_leaving))
RECORD(scene_triangle, INSTANCE, FIELD(triangle))
RECORD(flags, FIELD(first), FIELD(count))
RECORD(scene_selection, FIELD(only), FIELD(mask), FIELD(sorts))
RECORD(moving_scene, FIELD(opaque_), FIELD(opaque_counts_))
RECORD(instance_handle, FIELD(slot), FIELD(generation))
RECORD(instance_handle_result, FIELD(value.slot), FIELD(value.generation), FIELD(status))
RECORD(instance_word, HANDLE, FIELD(word))
RECORD(movement, HANDLE, FIELD_AS("rotation", transform.rotation), FIELD_AS("translation", transform.translation),
       FIELD_AS("scale", transform.scale))
RECORD(pair_filter, FIELD(only_moved))
RECORD(instance_pair, FIELD(a), FIELD(b))
RECORD(filled_instance_pairs, FIELD(count), FIELD_AS("a", next.a), FIELD_AS("b", next.b), FIELD(status))
RECORD(baked_pair, FIELD(moving), FIELD_AS("instance", baked.index), FIELD_AS("in_tile", baked.in_tile))
RECORD(filled_baked_pairs, FIELD(count), FIELD_AS("moving", next.moving), FIELD_AS("instance", next.baked.index),
       FIELD_AS("in_tile", next.baked.in_tile), FIELD(status))
RECORD(bytes, FIELD(bytes), FIELD(byte_count))
RECORD(joined_blob, FIELD(bytes), FIELD(byte_count), FIELD(translation))
RECORD(lattice, FIELD(origin), FIELD(step_exponent), FIELD(extent))
RECORD(mesh_view, FIELD(size), FIELD(positions), FIELD(position_count), FIELD(position_stride), FIELD(triangles),
       FIELD(triangle_count), FIELD(triangle_stride), FIELD(materials), FIELD(name), FIELD(file), FIELD(mesh),
       FIELD(coordinate_type), FIELD(index_type))
RECORD(bake_options, FIELD(size), FIELD(resolution), FIELD(resolution_kind), FIELD(profile), FIELD(effort),
       FIELD(builder), FIELD(original_ids), FIELD(drop_bad_triangles), FIELD(allow_empty), FIELD(strict),
       FIELD(with_remap), FIELD(oriented_box), FIELD(sphere), FIELD(k_dop), FIELD(chooses_origin), FIELD(flat_angle),
       FIELD(origin), FIELD(max_dropped), FIELD(duplicate_budget), FIELD(byte_price), FIELD(max_leaf_triangles))
RECORD(scene_bake_options, FIELD(size), FIELD(translations), FIELD(origin), FIELD(chooses_origin))
RECORD(bake_report, FIELD(source_triangles), FIELD(source_vertices), FINDING(not_finite), FINDING(index_out_of_range),
       FINDING(zero_area), FINDING(collapsed), FINDING(duplicate), FIELD(bounds_min), FIELD(bounds_max), FIELD(extent),
       FIELD(box_volume), FIELD(oriented_box_volume), FIELD(sphere_volume), FIELD(k_dop_volume), FIELD(step),
       FIELD(max_error), FIELD(origin), FIELD(bits), FIELD(triangles), FIELD(duplicate_references), FIELD(vertices),
       FIELD(nodes), FIELD(leaves), FIELD(depth), FIELD(bits_that_keep_closed), FIELD(bytes), FIELD(seconds),
       FIELD(warnings), FIELD(warning_count), FIELD(is_closed))
RECORD(bake_warning, FIELD(message), FIELD(kind))
RECORD(bake_result, FIELD(bytes), FIELD(byte_count), FIELD(remap), FIELD(remap_count), FIELD(report), FIELD(message),
       FIELD(place.file), FIELD(place.mesh), FIELD(place.triangle), FIELD(place.is_known), FIELD(status))

template <class Table>
constexpr Record record_of = {Table::name, sizeof(typename Table::Structure), std::size(Table::fields), Table::fields};

template <class... Tables>
struct Records {
    static constexpr Record all[] = {record_of<Tables>..., {nullptr, 0, 0, nullptr}};
};

using AllRecords =
    Records<blob_table, vec3d_table, filled_table, filled_lists_table, strided_vec3_table, ray_arrays_table,
            ray_hit_table, closest_point_result_table, float_result_table, distance_bounds_result_table,
            edge_kinds_result_table, sphere_result_table, oriented_box_result_table, k_dop_result_table,
            box_result_table, deformable_table, refit_result_table, scene_candidate_table, scene_contact_table,
            sweep_hit_table, sweep_options_table, original_triangle_table, original_triangle_result_table,
            original_hit_table, triangle_result_table, sphere_table, capsule_table, box_table, oriented_box_table,
            cone_table, convex_hull_table, convex_volume_table, triangle_table, segment_table, contact_table,
            contact_plane_table, vec3_result_table, transform_table, pair_contact_table, pair_touch_table,
            blob_distance_table, scene_table, instance_table, ray_table, scene_ray_hit_table,
            scene_closest_point_result_table, scene_sweep_hit_table, scene_sweep_options_table, scene_triangle_table,
            flags_table, scene_selection_table, moving_scene_table, instance_handle_table, instance_handle_result_table,
            instance_word_table, movement_table, pair_filter_table, instance_pair_table, filled_instance_pairs_table,
            baked_pair_table, filled_baked_pairs_table, bytes_table, joined_blob_table, lattice_table, mesh_view_table,
            bake_options_table, scene_bake_options_table, bake_report_table, bake_warning_table, bake_result_table>;

}  // namespace

/// Returns all records; the one after the last has no name.
extern "C" [[clang::export_name("wasm_records")]] const Record* wasm_records() { return AllRecords::all; }
