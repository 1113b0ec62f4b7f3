// Conversions between espalier.h and C++.
//
// Most structures have one layout in both languages, so that one passes for the other without a copy:
// tests/c/layouts_test.cpp proves it field by field. The attribute may_alias of the C structures announces it to
// optimisers. A function of C returns `c(query(cpp(blob), cpp(shape)))`.
//
// espalier.h declares the functions extern "C", and the definitions in this folder inherit that. Those with more than a
// line of parameters also take their types from there. Of others the option -Wmissing-declarations reports one whose
// parameters differ from its declaration.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include <espalier/espalier.h>
#include <espalier/espalier.hpp>
#include <espalier/scenes/statistics.hpp>

namespace espalier::detail {

/// Applies a macro to each structure of espalier_abi_sizes, in its order: `twin` if C and C++ have one layout for it,
/// else `other`.
// clang-format off
#define ESPALIER_C_STRUCTURES(twin, other)                                                                    \
    twin(yes_no, YesNo) twin(cursor, Cursor) twin(filled, Filled)                                             \
    twin(vec3, Vec3) twin(triangle, Triangle) twin(segment, Segment) ESPALIER_SHAPES_(twin)                   \
    twin(plane, Plane)                                                                                        \
    twin(blob, Blob) twin(lattice, Lattice)                                                                   \
    twin(contact, Contact) twin(edge_kinds, EdgeKinds) twin(edge_kinds_result, Result<EdgeKinds>)             \
    twin(k_dop, KDop) twin(sphere_result, Result<Sphere>)                                                     \
    twin(oriented_box_result, Result<OrientedBox>) twin(k_dop_result, Result<KDop>)                           \
    twin(ray, Ray) twin(ray_hit, RayHit)                                                                      \
    twin(original_triangle, OriginalTriangle) twin(original_triangle_result, Result<OriginalTriangle>)        \
    twin(original_hit, OriginalHit)                                                                           \
    other(convex_volume, ConvexVolume) twin(triangle_result, Result<Triangle>)                                \
    twin(closest_point_result, ClosestPoint) twin(float_result, Result<float>) twin(sweep_hit, SweepHit)      \
    twin(quaternion, Quaternion) twin(transform, Transform) twin(transform_result, Result<Transform>)         \
    other(placed_blob, PlacedBlob) twin(pair_contact, PairContact) twin(blob_distance, BlobDistance)          \
    twin(query_counters, QueryCounters) twin(pair_counters, PairCounters) twin(scene_counters, SceneCounters) \
    twin(distance_bounds_result, Result<DistanceBounds>)                                                      \
    twin(tree_child, TreeChild) twin(tree_node, TreeNode)                                                     \
    twin(lattice_point, LatticePoint) twin(lattice_box, LatticeBox) twin(lattice_segment, LatticeSegment)     \
    twin(lattice_point_result, Result<LatticePoint>) twin(lattice_box_result, Result<LatticeBox>)             \
    twin(lattice_hit, LatticeHit) twin(lattice_result, Result<Lattice>) twin(rounded_ray, RoundedRay)         \
    twin(instance_id, InstanceId) twin(instance, Instance) twin(instance_result, Result<Instance>)            \
    twin(mesh_result, Result<Blob>) twin(scene, BakedScene)                                                   \
    twin(scene_ray_hit, InScene<RayHit>) twin(scene_closest_point_result, InScene<ClosestPoint>)              \
    twin(scene_sweep_hit, InScene<SweepHit>) twin(scene_contact, InScene<Contact>)                            \
    twin(instance_handle, InstanceHandle) twin(instance_handle_result, Result<InstanceHandle>)                \
    twin(box_result, Result<Box>) twin(movement, Movement) twin(moving_scene, MovingScene)                    \
    twin(instance_pair, InstancePair) twin(baked_pair, BakedPair) other(pair_filter, PairFilter)              \
    twin(filled_instance_pairs, FilledPairs<InstancePair>) twin(filled_baked_pairs, FilledPairs<BakedPair>)   \
    twin(deformable, Deformable) twin(refit_result, RefitResult)                                              \
    other(convex_hull, ConvexHull) other(sweep_options, SweepOptions) twin(pair_touch, PairTouch)             \
    twin(strided_vec3, Strided<Vec3>) twin(strided_float, Strided<float>)                                     \
    twin(strided_triangle_id, Strided<TriangleId>) twin(filled_lists, FilledLists)                            \
    twin(ray_arrays, RayArrays) twin(sphere_arrays, SphereArrays) twin(box_arrays, BoxArrays)                 \
    other(scene_sweep_options, SceneSweepOptions) twin(vec3d, Vec3d)                                          \
    twin(contact_plane, ContactPlane) twin(vec3_result, Result<Vec3>)                                         \
    twin(triangle_data, TriangleData) twin(triangle_data_result, Result<TriangleData>)
// clang-format on

/// Applies a macro to each shape that sweeps take, and to each body of contacts.
#define ESPALIER_C_SWEPT_SHAPES(apply) apply(sphere) apply(capsule) apply(box) apply(oriented_box) apply(convex_hull)
#define ESPALIER_C_CONTACT_BODIES(apply) apply(sphere) apply(capsule) apply(oriented_box) apply(convex_hull)

// Overloads without a body: what they return is the twin of what they take.
#define ESPALIER_C_TWIN(name, Cpp) \
    Cpp twin_of(espalier_##name);  \
    espalier_##name twin_of(Cpp);
#define ESPALIER_C_OTHER(name, Cpp)
ESPALIER_C_STRUCTURES(ESPALIER_C_TWIN, ESPALIER_C_OTHER)
ESPALIER_C_TWIN(triangle_id, TriangleId)
#undef ESPALIER_C_OTHER
#undef ESPALIER_C_TWIN

/// The structure of the other language that has the layout of T.
template <class T>
using Twin = decltype(twin_of(std::declval<T>()));

/// Returns the same object as its twin. Null stays null.
template <class T>
Twin<T>* twin(T* value) {
    static_assert(sizeof(T) == sizeof(Twin<T>) && alignof(T) == alignof(Twin<T>));
    return reinterpret_cast<Twin<T>*>(value);
}
template <class T>
const Twin<T>* twin(const T* value) {
    return twin(const_cast<T*>(value));
}

/// Returns an argument of C as C++ takes it: a pointer as a reference to the same object, a value as a copy, an array
/// as a span.
template <class T>
auto cpp(T* value) -> decltype(*twin(value)) {
    return *twin(value);
}
template <class T>
constexpr Twin<T> cpp(const T& value) {
    return std::bit_cast<Twin<T>>(value);
}
template <class T>
auto cpp(T* values, std::size_t count) -> std::span<std::remove_pointer_t<decltype(twin(values))>> {
    return {twin(values), count};
}
inline std::span<const std::byte> cpp(const void* bytes, std::size_t size) {
    return {static_cast<const std::byte*>(bytes), size};
}
inline ConvexVolume cpp(const espalier_convex_volume* volume) { return {cpp(volume->planes, volume->plane_count)}; }
inline ConvexHull cpp(const espalier_convex_hull* hull) { return {cpp(hull->vertices, hull->vertex_count)}; }
inline PlacedBlob cpp(const espalier_placed_blob* placed) { return {cpp(placed->blob), cpp(&placed->transform)}; }

/// Returns a result of C++ as C has it.
template <class T>
constexpr Twin<T> c(const T& value) {
    return std::bit_cast<Twin<T>>(value);
}
template <class Enumeration>
constexpr std::uint8_t c(Enumeration value) requires(std::is_enum_v<Enumeration>) {
    return static_cast<std::uint8_t>(value);
}

/// Whether a structure of C, written as that of C++, lies where that may: other languages allocate at any address.
template <class T>
bool is_aligned(const T* place) {
    return reinterpret_cast<std::uintptr_t>(place) % alignof(Twin<T>) == 0;
}
/// Returns an array of C++ as C has it: the first element, and how many there are.
template <class T>
auto elements(std::span<T> array, std::size_t* count) {
    *count = array.size();
    return twin(array.data());
}

/// Returns what C++ passes to a visitor as C takes it: an id as a number, other objects by their address.
constexpr espalier_triangle_id passed(TriangleId triangle) { return triangle.index; }
constexpr espalier_instance_id passed(InstanceId instance) { return {instance.index, instance.in_tile}; }
template <class T>
const Twin<T>* passed(const T& value) {
    return twin(&value);
}

/// Returns a visitor of C as the C++ queries take it. It stops at any result that Answer does not list.
template <class Answer = Visit, class Function>
auto visitor(Function* visit, void* user) {
    return [=](const auto&... found) {
        const int answer = visit(passed(found)..., user);
        return answer >= 0 && answer < static_cast<int>(Answer::stop) ? static_cast<Answer>(answer) : Answer::stop;
    };
}

/// A filter as the C++ queries take it; a null one keeps all triangles. It must outlive the call.
struct Filter {
    espalier_triangle_filter function;
    void* user;
    bool operator()(TriangleId triangle) const { return function == nullptr || function(triangle.index, user); }
};

/// Returns options of a sweep as C++ takes them, with a filter that outlives the call.
template <class Options>
Options sweep_options(const auto& options, const auto& filter) {
    Options result;
    result.filter = filter;
    result.culling = static_cast<FaceCulling>(options.culling);
    result.ignore_leaving = options.ignore_leaving;
    result.skin = options.skin;
    return result;
}

/// The type of the parameter of a function that is the last but so many, counted from 1; and of its result.
template <std::size_t from_end, class Function>
struct ParameterOf;
template <std::size_t from_end, class Result, class First, class... Others>
struct ParameterOf<from_end, Result(First, Others...)> : ParameterOf<from_end, Result(Others...)> {};
template <std::size_t from_end, class Result, class First, class... Others>
requires(1 + sizeof...(Others) == from_end) struct ParameterOf<from_end, Result(First, Others...)> {
    using Type = First;
};
template <class Result, class... Parameters>
Result result_of(Result (*)(Parameters...));

}  // namespace espalier::detail

/// Defines a function of espalier.h, given the names of its parameters and what it returns.
#define ESPALIER_C_FUNCTION(function, parameters, ...)                  \
    decltype(espalier::detail::result_of(function)) function(           \
        ESPALIER_C_PARAMETERS(function, ESPALIER_C_NAMES parameters)) { \
        return __VA_ARGS__;                                             \
    }
/// The same of one that refuses to call no visitor.
#define ESPALIER_C_VISITING(function, parameters, ...) \
    ESPALIER_C_FUNCTION(function, parameters,          \
                        visit == nullptr ? c(espalier::QueryStatus::invalid_argument) : __VA_ARGS__)

#define ESPALIER_C_NAMES(...) __VA_ARGS__
#define ESPALIER_C_PARAMETERS(function, ...) \
    ESPALIER_C_CHOOSE(__VA_ARGS__, 9, 8, 7, 6, 5, 4, 3, 2, 1)(function, __VA_ARGS__)
#define ESPALIER_C_CHOOSE(a, b, c, d, e, f, g, h, i, count, ...) ESPALIER_C_PARAMETERS_##count
#define ESPALIER_C_PARAMETER(function, from_end, name) \
    espalier::detail::ParameterOf<from_end, decltype(function)>::Type name
#define ESPALIER_C_PARAMETERS_1(f, name) ESPALIER_C_PARAMETER(f, 1, name)
#define ESPALIER_C_PARAMETERS_2(f, name, ...) ESPALIER_C_PARAMETER(f, 2, name), ESPALIER_C_PARAMETERS_1(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_3(f, name, ...) ESPALIER_C_PARAMETER(f, 3, name), ESPALIER_C_PARAMETERS_2(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_4(f, name, ...) ESPALIER_C_PARAMETER(f, 4, name), ESPALIER_C_PARAMETERS_3(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_5(f, name, ...) ESPALIER_C_PARAMETER(f, 5, name), ESPALIER_C_PARAMETERS_4(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_6(f, name, ...) ESPALIER_C_PARAMETER(f, 6, name), ESPALIER_C_PARAMETERS_5(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_7(f, name, ...) ESPALIER_C_PARAMETER(f, 7, name), ESPALIER_C_PARAMETERS_6(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_8(f, name, ...) ESPALIER_C_PARAMETER(f, 8, name), ESPALIER_C_PARAMETERS_7(f, __VA_ARGS__)
#define ESPALIER_C_PARAMETERS_9(f, name, ...) ESPALIER_C_PARAMETER(f, 9, name), ESPALIER_C_PARAMETERS_8(f, __VA_ARGS__)
