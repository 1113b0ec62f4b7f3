// Claims that the compiler checks: espalier.h and the C++ headers say the same. No code.
#include <runtime/c/twins.hpp>

#include <type_traits>
#include <utility>

namespace espalier::detail {

static_assert(sizeof(espalier_blob) == sizeof(Blob) && alignof(espalier_blob) == alignof(Blob),
              "give espalier_blob the size of Blob, for 4-byte and for 8-byte pointers");
static_assert(std::is_trivially_copyable_v<Blob> && std::is_trivially_destructible_v<Blob>);

static_assert(sizeof(espalier_rounded_ray) == sizeof(RoundedRay) &&
                  alignof(espalier_rounded_ray) == alignof(RoundedRay),
              "give espalier_rounded_ray the size of RoundedRay");
static_assert(std::is_trivially_copyable_v<RoundedRay> && std::is_trivially_destructible_v<RoundedRay>);

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

template <class C>
constexpr bool same_layout() {
    using Cpp = Twin<C>;
    return sizeof(C) == sizeof(Cpp) && alignof(C) == alignof(Cpp) && initialisers<C>() == initialisers<Cpp>() &&
           std::is_trivially_copyable_v<Cpp> && std::is_standard_layout_v<Cpp>;
}

}  // namespace

#define SAME_FIELD(C, field)                                                                                      \
    static_assert(offsetof(C, field) == offsetof(Twin<C>, field) && sizeof(C::field) == sizeof(Twin<C>::field) && \
                  std::is_floating_point_v<decltype(C::field)> == std::is_floating_point_v<decltype(Twin<C>::field)>)

static_assert(same_layout<espalier_vec3>());
SAME_FIELD(espalier_vec3, x);
SAME_FIELD(espalier_vec3, y);
SAME_FIELD(espalier_vec3, z);
static_assert(same_layout<espalier_corners>());
SAME_FIELD(espalier_corners, a);
SAME_FIELD(espalier_corners, b);
SAME_FIELD(espalier_corners, c);
static_assert(same_layout<espalier_segment>());
SAME_FIELD(espalier_segment, from);
SAME_FIELD(espalier_segment, to);
static_assert(same_layout<espalier_sphere>());
SAME_FIELD(espalier_sphere, center);
SAME_FIELD(espalier_sphere, radius);
static_assert(same_layout<espalier_capsule>());
SAME_FIELD(espalier_capsule, from);
SAME_FIELD(espalier_capsule, to);
SAME_FIELD(espalier_capsule, radius);
static_assert(same_layout<espalier_box>());
SAME_FIELD(espalier_box, min);
SAME_FIELD(espalier_box, max);
static_assert(same_layout<espalier_oriented_box>());
SAME_FIELD(espalier_oriented_box, center);
SAME_FIELD(espalier_oriented_box, half_axes);
static_assert(same_layout<espalier_plane>());
SAME_FIELD(espalier_plane, normal);
SAME_FIELD(espalier_plane, offset);
static_assert(same_layout<espalier_original_triangle>());
SAME_FIELD(espalier_original_triangle, file);
SAME_FIELD(espalier_original_triangle, mesh);
SAME_FIELD(espalier_original_triangle, triangle);
SAME_FIELD(espalier_original_triangle, first_corner);
static_assert(same_layout<espalier_original_hit>());
SAME_FIELD(espalier_original_hit, file);
SAME_FIELD(espalier_original_hit, mesh);
SAME_FIELD(espalier_original_hit, triangle);
SAME_FIELD(espalier_original_hit, u);
SAME_FIELD(espalier_original_hit, v);
SAME_FIELD(espalier_original_hit, status);
static_assert(same_layout<espalier_edge_kinds>());
SAME_FIELD(espalier_edge_kinds, ab);
SAME_FIELD(espalier_edge_kinds, bc);
SAME_FIELD(espalier_edge_kinds, ca);
static_assert(same_layout<espalier_contact>());
SAME_FIELD(espalier_contact, triangle);
SAME_FIELD(espalier_contact, feature);
SAME_FIELD(espalier_contact, normal);
static_assert(same_layout<espalier_k_dop>());
SAME_FIELD(espalier_k_dop, lo);
SAME_FIELD(espalier_k_dop, hi);
static_assert(same_layout<espalier_ray>());
SAME_FIELD(espalier_ray, origin);
SAME_FIELD(espalier_ray, direction);
SAME_FIELD(espalier_ray, t_min);
SAME_FIELD(espalier_ray, t_max);
SAME_FIELD(espalier_ray, faces);
static_assert(same_layout<espalier_ray_hit>());
SAME_FIELD(espalier_ray_hit, t);
SAME_FIELD(espalier_ray_hit, u);
SAME_FIELD(espalier_ray_hit, v);
SAME_FIELD(espalier_ray_hit, normal);
SAME_FIELD(espalier_ray_hit, triangle);
static_assert(same_layout<espalier_float_result>());
SAME_FIELD(espalier_float_result, value);
SAME_FIELD(espalier_float_result, status);
static_assert(same_layout<espalier_hit_count>());
SAME_FIELD(espalier_hit_count, count);
SAME_FIELD(espalier_hit_count, status);
static_assert(same_layout<espalier_overlap_page>());
SAME_FIELD(espalier_overlap_page, status);
SAME_FIELD(espalier_overlap_page, count);
SAME_FIELD(espalier_overlap_page, next);
static_assert(same_layout<espalier_nearest>());
SAME_FIELD(espalier_nearest, point);
SAME_FIELD(espalier_nearest, distance);
SAME_FIELD(espalier_nearest, u);
SAME_FIELD(espalier_nearest, v);
SAME_FIELD(espalier_nearest, triangle);
SAME_FIELD(espalier_nearest, feature);
static_assert(same_layout<espalier_nearest_pair>());
SAME_FIELD(espalier_nearest_pair, on_shape);
SAME_FIELD(espalier_nearest_pair, on_surface);
SAME_FIELD(espalier_nearest_pair, distance);
SAME_FIELD(espalier_nearest_pair, u);
SAME_FIELD(espalier_nearest_pair, v);
SAME_FIELD(espalier_nearest_pair, triangle);
static_assert(same_layout<espalier_sweep_hit>());
SAME_FIELD(espalier_sweep_hit, t);
SAME_FIELD(espalier_sweep_hit, point);
SAME_FIELD(espalier_sweep_hit, normal);
SAME_FIELD(espalier_sweep_hit, triangle);
SAME_FIELD(espalier_sweep_hit, starts_overlapping);
static_assert(same_layout<espalier_quaternion>());
SAME_FIELD(espalier_quaternion, x);
SAME_FIELD(espalier_quaternion, y);
SAME_FIELD(espalier_quaternion, z);
SAME_FIELD(espalier_quaternion, w);
static_assert(same_layout<espalier_placement>());
SAME_FIELD(espalier_placement, rotation);
SAME_FIELD(espalier_placement, translation);
SAME_FIELD(espalier_placement, scale);
static_assert(same_layout<espalier_triangle_pair>());
SAME_FIELD(espalier_triangle_pair, a);
SAME_FIELD(espalier_triangle_pair, b);
static_assert(same_layout<espalier_pair_distance>());
SAME_FIELD(espalier_pair_distance, distance);
SAME_FIELD(espalier_pair_distance, on_a);
SAME_FIELD(espalier_pair_distance, on_b);
SAME_FIELD(espalier_pair_distance, pair);
static_assert(same_layout<espalier_query_counters>());
SAME_FIELD(espalier_query_counters, nodes);
SAME_FIELD(espalier_query_counters, leaves);
SAME_FIELD(espalier_query_counters, groups);
SAME_FIELD(espalier_query_counters, triangles);
SAME_FIELD(espalier_query_counters, candidates);
static_assert(same_layout<espalier_distance_bounds>());
SAME_FIELD(espalier_distance_bounds, lower);
SAME_FIELD(espalier_distance_bounds, upper);
static_assert(same_layout<espalier_tree_child>());
SAME_FIELD(espalier_tree_child, box);
SAME_FIELD(espalier_tree_child, is_leaf);
SAME_FIELD(espalier_tree_child, node);
SAME_FIELD(espalier_tree_child, first);
SAME_FIELD(espalier_tree_child, count);
static_assert(same_layout<espalier_tree_node>());
SAME_FIELD(espalier_tree_node, number);
SAME_FIELD(espalier_tree_node, depth);
SAME_FIELD(espalier_tree_node, child_count);
SAME_FIELD(espalier_tree_node, children);
static_assert(same_layout<espalier_lattice>());
SAME_FIELD(espalier_lattice, origin);
SAME_FIELD(espalier_lattice, step_exponent);
SAME_FIELD(espalier_lattice, extent);
static_assert(same_layout<espalier_steps>());
SAME_FIELD(espalier_steps, x);
SAME_FIELD(espalier_steps, y);
SAME_FIELD(espalier_steps, z);
static_assert(same_layout<espalier_box_in_steps>());
SAME_FIELD(espalier_box_in_steps, min);
SAME_FIELD(espalier_box_in_steps, max);
static_assert(same_layout<espalier_segment_in_steps>());
SAME_FIELD(espalier_segment_in_steps, from);
SAME_FIELD(espalier_segment_in_steps, to);
static_assert(same_layout<espalier_hit_in_steps>());
SAME_FIELD(espalier_hit_in_steps, t);
SAME_FIELD(espalier_hit_in_steps, side);
SAME_FIELD(espalier_hit_in_steps, triangle);

static_assert(sizeof(espalier_triangle) == sizeof(Triangle) && alignof(espalier_triangle) == alignof(Triangle));

// ---- enumerations and numbers -------------------------------------------------------------------------------------

#define SAME_VALUE(c, cpp) static_assert(int{c} == static_cast<int>(cpp))

static_assert(sizeof(espalier_status) == sizeof(Status));
SAME_VALUE(ESPALIER_STATUS_OK, Status::ok);
SAME_VALUE(ESPALIER_STATUS_TOO_SHORT, Status::too_short);
SAME_VALUE(ESPALIER_STATUS_TRAILING_BYTES, Status::trailing_bytes);
SAME_VALUE(ESPALIER_STATUS_NOT_A_BLOB, Status::not_a_blob);
SAME_VALUE(ESPALIER_STATUS_UNSUPPORTED_VERSION, Status::unsupported_version);
SAME_VALUE(ESPALIER_STATUS_UNSUPPORTED_PROFILE, Status::unsupported_profile);
SAME_VALUE(ESPALIER_STATUS_UNSUPPORTED_FEATURE, Status::unsupported_feature);
SAME_VALUE(ESPALIER_STATUS_BAD_HEADER, Status::bad_header);
SAME_VALUE(ESPALIER_STATUS_BAD_CHECKSUM, Status::bad_checksum);
SAME_VALUE(ESPALIER_STATUS_BAD_NODE, Status::bad_node);
SAME_VALUE(ESPALIER_STATUS_BAD_LEAF, Status::bad_leaf);
SAME_VALUE(ESPALIER_STATUS_BAD_SECTION, Status::bad_section);
SAME_VALUE(ESPALIER_STATUS_MISALIGNED, Status::misaligned);
SAME_VALUE(ESPALIER_STATUS_NOT_A_REMAP, Status::not_a_remap);
SAME_VALUE(ESPALIER_STATUS_OTHER_BLOB, Status::other_blob);

static_assert(sizeof(espalier_query_status) == sizeof(QueryStatus));
SAME_VALUE(ESPALIER_QUERY_OK, QueryStatus::ok);
SAME_VALUE(ESPALIER_QUERY_INVALID_ARGUMENT, QueryStatus::invalid_argument);
SAME_VALUE(ESPALIER_QUERY_OUT_OF_RANGE, QueryStatus::out_of_range);
SAME_VALUE(ESPALIER_QUERY_NOT_CLOSED, QueryStatus::not_closed);
SAME_VALUE(ESPALIER_QUERY_HAS_COPIES, QueryStatus::has_copies);
SAME_VALUE(ESPALIER_QUERY_WORK_LIMIT, QueryStatus::work_limit);
SAME_VALUE(ESPALIER_QUERY_OUTPUT_FULL, QueryStatus::output_full);
SAME_VALUE(ESPALIER_QUERY_NOT_FOUND, QueryStatus::not_found);
SAME_VALUE(ESPALIER_QUERY_NOT_OPEN, QueryStatus::not_open);
SAME_VALUE(ESPALIER_QUERY_NO_DATA, QueryStatus::no_data);

static_assert(sizeof(espalier_feature) == sizeof(Feature));
SAME_VALUE(ESPALIER_FEATURE_FACE, Feature::face);
SAME_VALUE(ESPALIER_FEATURE_EDGE_AB, Feature::edge_ab);
SAME_VALUE(ESPALIER_FEATURE_EDGE_BC, Feature::edge_bc);
SAME_VALUE(ESPALIER_FEATURE_EDGE_CA, Feature::edge_ca);
SAME_VALUE(ESPALIER_FEATURE_VERTEX_A, Feature::vertex_a);
SAME_VALUE(ESPALIER_FEATURE_VERTEX_B, Feature::vertex_b);
SAME_VALUE(ESPALIER_FEATURE_VERTEX_C, Feature::vertex_c);

static_assert(sizeof(espalier_profile) == sizeof(format::Profile));
SAME_VALUE(ESPALIER_PROFILE_FAST, format::Profile::fast);
SAME_VALUE(ESPALIER_PROFILE_BALANCED, format::Profile::balanced);
SAME_VALUE(ESPALIER_PROFILE_SMALL, format::Profile::small);
SAME_VALUE(ESPALIER_PROFILE_TINY, format::Profile::tiny);

static_assert(sizeof(espalier_edge_kind) == sizeof(EdgeKind));
SAME_VALUE(ESPALIER_EDGE_FLAT, EdgeKind::flat);
SAME_VALUE(ESPALIER_EDGE_CONVEX, EdgeKind::convex);
SAME_VALUE(ESPALIER_EDGE_CONCAVE, EdgeKind::concave);
SAME_VALUE(ESPALIER_EDGE_OPEN, EdgeKind::open);

static_assert(sizeof(espalier_faces) == sizeof(Faces));
SAME_VALUE(ESPALIER_FACES_BOTH, Faces::both);
SAME_VALUE(ESPALIER_FACES_FRONT, Faces::front);
SAME_VALUE(ESPALIER_FACES_BACK, Faces::back);

SAME_VALUE(ESPALIER_KEEP_GOING, keep_going);
SAME_VALUE(ESPALIER_STOP, stop);
SAME_VALUE(ESPALIER_NODE_DESCEND, NodeVisit::descend);
SAME_VALUE(ESPALIER_NODE_SKIP, NodeVisit::skip);
SAME_VALUE(ESPALIER_NODE_END, NodeVisit::end);

SAME_VALUE(ESPALIER_MAX_PLANES, max_planes);
SAME_VALUE(ESPALIER_MAX_SEGMENT_STEPS, max_segment_steps);
SAME_VALUE(ESPALIER_MAX_CHILDREN, format::max_children);
SAME_VALUE(ESPALIER_K_DOP_COUNT, KDop::count);
SAME_VALUE(ESPALIER_VERSION_MAJOR, library_version_major);
SAME_VALUE(ESPALIER_VERSION_MINOR, library_version_minor);
SAME_VALUE(ESPALIER_VERSION_PATCH, library_version_patch);
static_assert(ESPALIER_NO_TRIANGLE == no_triangle.index);
static_assert(ESPALIER_NO_WORK_LIMIT == WorkLimit{}.pairs);

}  // namespace espalier::detail
