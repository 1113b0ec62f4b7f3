// Claims that the compiler checks: the structures, enumerations and numbers of espalier.h are those of the C++ headers.
#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include <runtime/c/abi.hpp>

namespace espalier::detail {

// ---- structures ---------------------------------------------------------------------------------------------------

namespace {

struct Anything {
    template <class T>
    operator T() const;  // NOLINT(google-explicit-constructor): that it converts silently is its use
};

template <class T, std::size_t... index>
constexpr bool takes(std::index_sequence<index...>) {
    return requires { T{(static_cast<void>(index), Anything{})...}; };
}

/// How many initialisers an aggregate takes: a field that only one of two twins has would hide in padding otherwise.
template <class T, std::size_t count = 40>
constexpr std::size_t initialisers() {
    if constexpr (count == 0 || takes<T>(std::make_index_sequence<count>{})) return count;
    else return initialisers<T, count - 1>();
}

/// Returns whether one passes for the other. Where it fails for espalier_blob, espalier_scene or
/// espalier_deformable, give that the size of Blob, BakedScene or Deformable, for pointers of 4 and of 8 bytes. Classes
/// with private members have no initialisers.
template <class C, class Cpp>
constexpr bool same_layout() {
    static_assert(std::is_same_v<Twin<C>, Cpp> && std::is_same_v<Twin<Cpp>, C>);
    if (std::is_aggregate_v<Cpp> && initialisers<C>() != initialisers<Cpp>()) return false;
    return sizeof(C) == sizeof(Cpp) && alignof(C) == alignof(Cpp) && std::is_trivially_copyable_v<Cpp> &&
           std::is_trivially_destructible_v<Cpp> && std::is_standard_layout_v<Cpp>;
}

}  // namespace

#define SAME_LAYOUT(name, Cpp) \
    static_assert(same_layout<espalier_##name, Cpp>(), "espalier_" #name " differs from " #Cpp);
#define OTHER_LAYOUT(name, Cpp)
ESPALIER_C_STRUCTURES(SAME_LAYOUT, OTHER_LAYOUT)
SAME_LAYOUT(triangle_id, TriangleId)

#define SAME_FIELD(C, field)                                                                                      \
    static_assert(offsetof(C, field) == offsetof(Twin<C>, field) && sizeof(C::field) == sizeof(Twin<C>::field) && \
                  std::is_floating_point_v<decltype(C::field)> == std::is_floating_point_v<decltype(Twin<C>::field)>)

#define SAME_RESULT(C)    \
    SAME_FIELD(C, value); \
    SAME_FIELD(C, status)

SAME_FIELD(espalier_cursor, place);
SAME_FIELD(espalier_strided_vec3, first);
SAME_FIELD(espalier_strided_vec3, stride);
SAME_FIELD(espalier_strided_float, first);
SAME_FIELD(espalier_strided_float, stride);
SAME_FIELD(espalier_strided_triangle_id, first);
SAME_FIELD(espalier_strided_triangle_id, stride);
SAME_FIELD(espalier_filled_lists, lists);
SAME_FIELD(espalier_filled_lists, count);
SAME_FIELD(espalier_filled_lists, needed);
SAME_FIELD(espalier_filled_lists, status);
SAME_FIELD(espalier_ray_arrays, origins);
SAME_FIELD(espalier_ray_arrays, directions);
SAME_FIELD(espalier_ray_arrays, t_min);
SAME_FIELD(espalier_ray_arrays, t_max);
SAME_FIELD(espalier_ray_arrays, culling);
SAME_FIELD(espalier_sphere_arrays, centers);
SAME_FIELD(espalier_sphere_arrays, radii);
SAME_FIELD(espalier_box_arrays, min);
SAME_FIELD(espalier_box_arrays, max);
SAME_FIELD(espalier_vec3, x);
SAME_FIELD(espalier_vec3, y);
SAME_FIELD(espalier_vec3, z);
SAME_FIELD(espalier_triangle, a);
SAME_FIELD(espalier_triangle, b);
SAME_FIELD(espalier_triangle, c);
SAME_FIELD(espalier_segment, from);
SAME_FIELD(espalier_segment, to);
SAME_FIELD(espalier_sphere, center);
SAME_FIELD(espalier_sphere, radius);
SAME_FIELD(espalier_capsule, from);
SAME_FIELD(espalier_capsule, to);
SAME_FIELD(espalier_capsule, radius);
SAME_FIELD(espalier_box, min);
SAME_FIELD(espalier_box, max);
SAME_FIELD(espalier_oriented_box, center);
SAME_FIELD(espalier_oriented_box, half_axes);
SAME_FIELD(espalier_cone, apex);
SAME_FIELD(espalier_cone, axis);
SAME_FIELD(espalier_cone, radius);
SAME_FIELD(espalier_plane, normal);
SAME_FIELD(espalier_plane, offset);
SAME_FIELD(espalier_filled, count);
SAME_FIELD(espalier_filled, next);
SAME_FIELD(espalier_filled, status);
SAME_FIELD(espalier_triangle_result, value);
SAME_FIELD(espalier_triangle_result, status);
SAME_FIELD(espalier_original_triangle, file);
SAME_FIELD(espalier_original_triangle, mesh);
SAME_FIELD(espalier_original_triangle, triangle);
SAME_FIELD(espalier_original_triangle, first_corner);
SAME_FIELD(espalier_original_hit, file);
SAME_FIELD(espalier_original_hit, mesh);
SAME_FIELD(espalier_original_hit, triangle);
SAME_FIELD(espalier_original_hit, u);
SAME_FIELD(espalier_original_hit, v);
SAME_FIELD(espalier_original_hit, status);
SAME_FIELD(espalier_edge_kinds, ab);
SAME_FIELD(espalier_edge_kinds, bc);
SAME_FIELD(espalier_edge_kinds, ca);
SAME_FIELD(espalier_k_dop, lo);
SAME_FIELD(espalier_k_dop, hi);
SAME_FIELD(espalier_ray, origin);
SAME_FIELD(espalier_ray, direction);
SAME_FIELD(espalier_ray, t_min);
SAME_FIELD(espalier_ray, t_max);
SAME_FIELD(espalier_ray, culling);
static_assert(sizeof(RayHit) == 32);
SAME_FIELD(espalier_ray_hit, t);
SAME_FIELD(espalier_ray_hit, u);
SAME_FIELD(espalier_ray_hit, v);
SAME_FIELD(espalier_ray_hit, normal);
SAME_FIELD(espalier_ray_hit, triangle);
SAME_FIELD(espalier_ray_hit, status);
SAME_FIELD(espalier_ray_hit, side);
SAME_FIELD(espalier_ray_hit, reserved);
SAME_RESULT(espalier_edge_kinds_result);
SAME_RESULT(espalier_float_result);
SAME_RESULT(espalier_k_dop_result);
SAME_RESULT(espalier_oriented_box_result);
SAME_RESULT(espalier_original_triangle_result);
SAME_RESULT(espalier_sphere_result);
static_assert(sizeof(ClosestPoint) == 56);
SAME_FIELD(espalier_closest_point_result, point);
SAME_FIELD(espalier_closest_point_result, on_shape);
SAME_FIELD(espalier_closest_point_result, face_normal);
SAME_FIELD(espalier_closest_point_result, distance);
SAME_FIELD(espalier_closest_point_result, u);
SAME_FIELD(espalier_closest_point_result, v);
SAME_FIELD(espalier_closest_point_result, triangle);
SAME_FIELD(espalier_closest_point_result, status);
SAME_FIELD(espalier_closest_point_result, feature);
SAME_FIELD(espalier_closest_point_result, side);
SAME_FIELD(espalier_closest_point_result, reserved);
static_assert(sizeof(Contact) == 36);
SAME_FIELD(espalier_contact, point);
SAME_FIELD(espalier_contact, normal);
SAME_FIELD(espalier_contact, distance);
SAME_FIELD(espalier_contact, triangle);
SAME_FIELD(espalier_contact, feature);
SAME_FIELD(espalier_contact, side);
SAME_FIELD(espalier_contact, reserved);
static_assert(sizeof(SweepHit) == 48);
SAME_FIELD(espalier_sweep_hit, t);
SAME_FIELD(espalier_sweep_hit, point);
SAME_FIELD(espalier_sweep_hit, normal);
SAME_FIELD(espalier_sweep_hit, face_normal);
SAME_FIELD(espalier_sweep_hit, triangle);
SAME_FIELD(espalier_sweep_hit, status);
SAME_FIELD(espalier_sweep_hit, feature);
SAME_FIELD(espalier_sweep_hit, reserved);
SAME_FIELD(espalier_sweep_hit, starts_overlapping);
SAME_FIELD(espalier_quaternion, x);
SAME_FIELD(espalier_quaternion, y);
SAME_FIELD(espalier_quaternion, z);
SAME_FIELD(espalier_quaternion, w);
SAME_FIELD(espalier_transform, rotation);
SAME_FIELD(espalier_transform, translation);
SAME_FIELD(espalier_transform, scale);
SAME_FIELD(espalier_transform_result, value);
SAME_FIELD(espalier_transform_result, status);
SAME_FIELD(espalier_pair_contact, a);
SAME_FIELD(espalier_pair_contact, b);
SAME_FIELD(espalier_pair_contact, status);
SAME_FIELD(espalier_pair_touch, points);
SAME_FIELD(espalier_pair_touch, normal);
SAME_FIELD(espalier_pair_touch, depth);
SAME_FIELD(espalier_pair_touch, a);
SAME_FIELD(espalier_pair_touch, b);
SAME_FIELD(espalier_pair_touch, count);
SAME_FIELD(espalier_pair_touch, status);
SAME_FIELD(espalier_pair_touch, reserved);
SAME_FIELD(espalier_blob_distance, distance);
SAME_FIELD(espalier_blob_distance, on_a);
SAME_FIELD(espalier_blob_distance, on_b);
SAME_FIELD(espalier_blob_distance, a);
SAME_FIELD(espalier_blob_distance, b);
SAME_FIELD(espalier_blob_distance, status);
SAME_FIELD(espalier_query_counters, nodes);
SAME_FIELD(espalier_query_counters, leaves);
SAME_FIELD(espalier_query_counters, groups);
SAME_FIELD(espalier_query_counters, triangles);
SAME_FIELD(espalier_query_counters, candidates);
SAME_FIELD(espalier_pair_counters, box_pairs);
SAME_FIELD(espalier_pair_counters, leaf_pairs);
SAME_FIELD(espalier_pair_counters, triangle_pairs);
SAME_FIELD(espalier_scene_counters, box_tests);
SAME_FIELD(espalier_scene_counters, pairs);
SAME_FIELD(espalier_distance_bounds_result, value);
SAME_FIELD(espalier_distance_bounds_result, status);
static_assert(offsetof(DistanceBounds, lower) == 0 && offsetof(DistanceBounds, upper) == sizeof(float));
SAME_FIELD(espalier_tree_child, box);
SAME_FIELD(espalier_tree_child, is_leaf);
SAME_FIELD(espalier_tree_child, node);
SAME_FIELD(espalier_tree_child, first);
SAME_FIELD(espalier_tree_child, count);
SAME_FIELD(espalier_tree_node, number);
SAME_FIELD(espalier_tree_node, depth);
SAME_FIELD(espalier_tree_node, child_count);
SAME_FIELD(espalier_tree_node, children);
SAME_FIELD(espalier_lattice, origin);
SAME_FIELD(espalier_lattice, step_exponent);
SAME_FIELD(espalier_lattice, extent);
SAME_FIELD(espalier_lattice_point, x);
SAME_FIELD(espalier_lattice_point, y);
SAME_FIELD(espalier_lattice_point, z);
SAME_FIELD(espalier_lattice_box, min);
SAME_FIELD(espalier_lattice_box, max);
SAME_FIELD(espalier_lattice_segment, from);
SAME_FIELD(espalier_lattice_segment, to);
static_assert(sizeof(LatticeHit) == 12);
SAME_FIELD(espalier_lattice_hit, t);
SAME_FIELD(espalier_lattice_hit, triangle);
SAME_FIELD(espalier_lattice_hit, status);
SAME_FIELD(espalier_lattice_hit, side);
SAME_FIELD(espalier_lattice_hit, reserved);
SAME_RESULT(espalier_lattice_point_result);
SAME_RESULT(espalier_lattice_box_result);
SAME_RESULT(espalier_lattice_result);
SAME_FIELD(espalier_instance, transform);
SAME_FIELD(espalier_instance, mesh);
SAME_FIELD(espalier_instance, mask);
SAME_FIELD(espalier_instance, user);
SAME_FIELD(espalier_instance, source);
SAME_RESULT(espalier_instance_result);
SAME_FIELD(espalier_instance_id, index);
SAME_FIELD(espalier_instance_id, in_tile);
SAME_RESULT(espalier_mesh_result);
SAME_FIELD(espalier_scene_ray_hit, hit);
SAME_FIELD(espalier_scene_ray_hit, instance);
SAME_FIELD(espalier_scene_closest_point_result, hit);
SAME_FIELD(espalier_scene_closest_point_result, instance);
SAME_FIELD(espalier_scene_sweep_hit, hit);
SAME_FIELD(espalier_scene_sweep_hit, instance);
SAME_FIELD(espalier_instance_handle, slot);
SAME_FIELD(espalier_instance_handle, generation);
SAME_RESULT(espalier_instance_handle_result);
SAME_RESULT(espalier_box_result);
SAME_FIELD(espalier_movement, instance);
SAME_FIELD(espalier_movement, transform);
SAME_FIELD(espalier_instance_pair, a);
SAME_FIELD(espalier_instance_pair, b);
SAME_FIELD(espalier_baked_pair, moving);
SAME_FIELD(espalier_baked_pair, baked);
SAME_FIELD(espalier_filled_instance_pairs, count);
SAME_FIELD(espalier_filled_instance_pairs, next);
SAME_FIELD(espalier_filled_instance_pairs, status);
SAME_FIELD(espalier_filled_baked_pairs, count);
SAME_FIELD(espalier_filled_baked_pairs, next);
SAME_FIELD(espalier_filled_baked_pairs, status);
SAME_FIELD(espalier_refit_result, status);
SAME_FIELD(espalier_refit_result, position);
SAME_FIELD(espalier_refit_result, quality);

// ---- enumerations and numbers -------------------------------------------------------------------------------------

#define SAME_VALUE(c, cpp) static_assert(int{c} == static_cast<int>(cpp))

static_assert(sizeof(espalier_open_status) == sizeof(OpenStatus));
SAME_VALUE(ESPALIER_OPEN_OK, OpenStatus::ok);
SAME_VALUE(ESPALIER_OPEN_TOO_SHORT, OpenStatus::too_short);
SAME_VALUE(ESPALIER_OPEN_TRAILING_BYTES, OpenStatus::trailing_bytes);
SAME_VALUE(ESPALIER_OPEN_NOT_A_BLOB, OpenStatus::not_a_blob);
SAME_VALUE(ESPALIER_OPEN_UNSUPPORTED_VERSION, OpenStatus::unsupported_version);
SAME_VALUE(ESPALIER_OPEN_UNSUPPORTED_PROFILE, OpenStatus::unsupported_profile);
SAME_VALUE(ESPALIER_OPEN_UNSUPPORTED_FEATURE, OpenStatus::unsupported_feature);
SAME_VALUE(ESPALIER_OPEN_BAD_HEADER, OpenStatus::bad_header);
SAME_VALUE(ESPALIER_OPEN_BAD_CHECKSUM, OpenStatus::bad_checksum);
SAME_VALUE(ESPALIER_OPEN_BAD_NODE, OpenStatus::bad_node);
SAME_VALUE(ESPALIER_OPEN_BAD_LEAF, OpenStatus::bad_leaf);
SAME_VALUE(ESPALIER_OPEN_BAD_SECTION, OpenStatus::bad_section);
SAME_VALUE(ESPALIER_OPEN_NOT_OPENED, OpenStatus::not_opened);
SAME_VALUE(ESPALIER_OPEN_MISALIGNED, OpenStatus::misaligned);
SAME_VALUE(ESPALIER_OPEN_NOT_A_REMAP, OpenStatus::not_a_remap);
SAME_VALUE(ESPALIER_OPEN_OTHER_BLOB, OpenStatus::other_blob);
SAME_VALUE(ESPALIER_OPEN_NOT_A_SCENE, OpenStatus::not_a_scene);
SAME_VALUE(ESPALIER_OPEN_BAD_INSTANCE, OpenStatus::bad_instance);
SAME_VALUE(ESPALIER_OPEN_TOO_FEW_MESHES, OpenStatus::too_few_meshes);

static_assert(sizeof(espalier_query_status) == sizeof(QueryStatus));
SAME_VALUE(ESPALIER_QUERY_OK, QueryStatus::ok);
SAME_VALUE(ESPALIER_QUERY_INVALID_ARGUMENT, QueryStatus::invalid_argument);
SAME_VALUE(ESPALIER_QUERY_OUT_OF_RANGE, QueryStatus::out_of_range);
SAME_VALUE(ESPALIER_QUERY_NOT_CLOSED, QueryStatus::not_closed);
SAME_VALUE(ESPALIER_QUERY_STOPPED, QueryStatus::stopped);
SAME_VALUE(ESPALIER_QUERY_WORK_LIMIT, QueryStatus::work_limit);
SAME_VALUE(ESPALIER_QUERY_OUTPUT_FULL, QueryStatus::output_full);
SAME_VALUE(ESPALIER_QUERY_NOT_FOUND, QueryStatus::not_found);
SAME_VALUE(ESPALIER_QUERY_NOT_OPEN, QueryStatus::not_open);
SAME_VALUE(ESPALIER_QUERY_NO_DATA, QueryStatus::no_data);
SAME_VALUE(ESPALIER_QUERY_NO_ROOM, QueryStatus::no_room);
SAME_VALUE(ESPALIER_QUERY_STALE_HANDLE, QueryStatus::stale_handle);
SAME_VALUE(ESPALIER_QUERY_NOT_REFITTED, QueryStatus::not_refitted);

static_assert(sizeof(espalier_feature) == sizeof(Feature));
SAME_VALUE(ESPALIER_FEATURE_FACE, Feature::face);
SAME_VALUE(ESPALIER_FEATURE_EDGE_AB, Feature::edge_ab);
SAME_VALUE(ESPALIER_FEATURE_EDGE_BC, Feature::edge_bc);
SAME_VALUE(ESPALIER_FEATURE_EDGE_CA, Feature::edge_ca);
SAME_VALUE(ESPALIER_FEATURE_VERTEX_A, Feature::vertex_a);
SAME_VALUE(ESPALIER_FEATURE_VERTEX_B, Feature::vertex_b);
SAME_VALUE(ESPALIER_FEATURE_VERTEX_C, Feature::vertex_c);

static_assert(sizeof(espalier_profile) == sizeof(Profile));
SAME_VALUE(ESPALIER_PROFILE_FAST, Profile::fast);
SAME_VALUE(ESPALIER_PROFILE_BALANCED, Profile::balanced);
SAME_VALUE(ESPALIER_PROFILE_SMALL, Profile::small);
SAME_VALUE(ESPALIER_PROFILE_TINY, Profile::tiny);

static_assert(sizeof(espalier_edge_kind) == sizeof(EdgeKind));
SAME_VALUE(ESPALIER_EDGE_FLAT, EdgeKind::flat);
SAME_VALUE(ESPALIER_EDGE_CONVEX, EdgeKind::convex);
SAME_VALUE(ESPALIER_EDGE_CONCAVE, EdgeKind::concave);
SAME_VALUE(ESPALIER_EDGE_BOUNDARY, EdgeKind::boundary);

static_assert(sizeof(espalier_face_culling) == sizeof(FaceCulling));
SAME_VALUE(ESPALIER_FACE_CULLING_NONE, FaceCulling::none);
SAME_VALUE(ESPALIER_FACE_CULLING_BACK, FaceCulling::back);
SAME_VALUE(ESPALIER_FACE_CULLING_FRONT, FaceCulling::front);

static_assert(sizeof(espalier_side) == sizeof(Side));
SAME_VALUE(ESPALIER_SIDE_FRONT, Side::front);
SAME_VALUE(ESPALIER_SIDE_BACK, Side::back);

SAME_VALUE(ESPALIER_VISIT_NEXT, Visit::next);
SAME_VALUE(ESPALIER_VISIT_STOP, Visit::stop);
SAME_VALUE(ESPALIER_NODE_DESCEND, NodeVisit::descend);
SAME_VALUE(ESPALIER_NODE_SKIP, NodeVisit::skip);
SAME_VALUE(ESPALIER_NODE_STOP, NodeVisit::stop);

SAME_VALUE(ESPALIER_MAX_PLANES, max_planes);
SAME_VALUE(ESPALIER_MAX_HULL_VERTICES, max_hull_vertices);
SAME_VALUE(ESPALIER_MAX_TOUCH_POINTS, max_touch_points);
SAME_VALUE(ESPALIER_MAX_LATTICE_COORDINATE, max_lattice_coordinate);
SAME_VALUE(ESPALIER_MAX_CHILDREN, format::max_children);
SAME_VALUE(ESPALIER_K_DOP_COUNT, KDop::count);
SAME_VALUE(ESPALIER_VERSION_MAJOR, library_version_major);
SAME_VALUE(ESPALIER_VERSION_MINOR, library_version_minor);
SAME_VALUE(ESPALIER_VERSION_PATCH, library_version_patch);
static_assert(ESPALIER_NO_TRIANGLE == no_triangle.index);
static_assert(ESPALIER_NO_INSTANCE == no_instance.index);
static_assert(ESPALIER_WORK_UNLIMITED == WorkLimit::unlimited().visits());

}  // namespace espalier::detail

namespace {

/// Every match of the pattern's group.
std::set<std::string> names_in(const std::string& text, const char* pattern) {
    const std::regex name(pattern);
    std::set<std::string> names;
    for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match)
        names.insert((*match)[1]);
    return names;
}

}  // namespace

TEST_SUITE("layouts") {
    TEST_CASE("c api: espalier_abi has the size of every structure") {
        std::set<std::string> structures;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(
                 std::filesystem::path(ESPALIER_PROJECT_FOLDER) / "lib/espalier/c")) {
            if (!entry.is_regular_file()) continue;
            std::ifstream file(entry.path());
            const std::string header(std::istreambuf_iterator<char>(file), {});
            structures.merge(names_in(header, "typedef struct [A-Z_]+ espalier_([a-z_0-9]+) \\{"));
        }
        REQUIRE(structures.erase("abi_sizes") == 1);
#define NAME(name, Cpp) #name,
        const std::set<std::string> listed = {ESPALIER_C_STRUCTURES(NAME, NAME)};
#undef NAME
        CHECK(listed == structures);
        // espalier_abi() fills in a field for each that is listed: there are no others.
        CHECK(sizeof(espalier_abi_sizes) == (3 + listed.size()) * sizeof(std::uint16_t));

        const espalier_abi_sizes sizes = espalier_abi();
        CHECK(sizes.version_major == espalier::library_version_major);
        CHECK(sizes.version_minor == espalier::library_version_minor);
        CHECK(sizes.version_patch == espalier::library_version_patch);
        CHECK(sizes.blob == sizeof(espalier::Blob));
        CHECK(sizes.instance_id == sizeof(espalier::InstanceId));
        CHECK(sizes.scene == sizeof(espalier::BakedScene));
        CHECK(sizes.vec3 == sizeof(espalier::Vec3));
        CHECK(sizes.rounded_ray == sizeof(espalier::RoundedRay));
        CHECK(sizes.scene_counters == sizeof(espalier::SceneCounters));
        CHECK(sizes.moving_scene == sizeof(espalier::MovingScene));
        CHECK(sizes.filled_baked_pairs == sizeof(espalier::FilledPairs<espalier::BakedPair>));
        CHECK(sizes.deformable == sizeof(espalier::Deformable));
        CHECK(sizes.refit_result == sizeof(espalier::RefitResult));
    }

    TEST_CASE("c api: a loaded library has its version and the size of each structure by name") {
        CHECK(std::string(espalier_version()) == ESPALIER_VERSION);
#define ASK(name, Cpp) CHECK(espalier_size_of(#name) == sizeof(espalier_##name));
        ESPALIER_C_STRUCTURES(ASK, ASK)
#undef ASK
        for (const char* const other : {"", "blo", "blobs", "espalier_blob", "mesh_view", "Blob"})
            CHECK_MESSAGE(espalier_size_of(other) == 0, other);
        CHECK(espalier_size_of(nullptr) == 0);
    }
}
