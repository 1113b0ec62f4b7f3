// The structures of espalier.h and their C++ twins have one layout (twins.cpp asserts it), so that passing one for the
// other costs nothing. Optimisers are told by the attribute on the C structures.
#pragma once

#include <bit>
#include <cstddef>
#include <span>

#include <espalier/espalier.h>
#include <espalier/espalier.hpp>

namespace espalier::detail {

template <class C>
struct TwinOf;

#define ESPALIER_TWINS(C, CPP) \
    template <>                \
    struct TwinOf<C> {         \
        using Type = CPP;      \
    };                         \
    template <>                \
    struct TwinOf<CPP> {       \
        using Type = C;        \
    }
ESPALIER_TWINS(espalier_blob, Blob);
ESPALIER_TWINS(espalier_box, Box);
ESPALIER_TWINS(espalier_box_in_steps, BoxInSteps);
ESPALIER_TWINS(espalier_capsule, Capsule);
ESPALIER_TWINS(espalier_contact, Contact);
ESPALIER_TWINS(espalier_corners, Corners);
ESPALIER_TWINS(espalier_distance_bounds, DistanceBounds);
ESPALIER_TWINS(espalier_edge_kinds, EdgeKinds);
ESPALIER_TWINS(espalier_float_result, Result<float>);
ESPALIER_TWINS(espalier_hit_count, HitCount);
ESPALIER_TWINS(espalier_hit_in_steps, HitInSteps);
ESPALIER_TWINS(espalier_k_dop, KDop);
ESPALIER_TWINS(espalier_lattice, Lattice);
ESPALIER_TWINS(espalier_nearest, Nearest);
ESPALIER_TWINS(espalier_nearest_pair, NearestPair);
ESPALIER_TWINS(espalier_oriented_box, OrientedBox);
ESPALIER_TWINS(espalier_original_hit, OriginalHit);
ESPALIER_TWINS(espalier_original_triangle, OriginalTriangle);
ESPALIER_TWINS(espalier_overlap_page, OverlapPage);
ESPALIER_TWINS(espalier_pair_distance, PairDistance);
ESPALIER_TWINS(espalier_placement, Placement);
ESPALIER_TWINS(espalier_plane, Plane);
ESPALIER_TWINS(espalier_quaternion, Quaternion);
ESPALIER_TWINS(espalier_query_counters, QueryCounters);
ESPALIER_TWINS(espalier_ray, Ray);
ESPALIER_TWINS(espalier_ray_hit, RayHit);
ESPALIER_TWINS(espalier_rounded_ray, RoundedRay);
ESPALIER_TWINS(espalier_segment, Segment);
ESPALIER_TWINS(espalier_segment_in_steps, SegmentInSteps);
ESPALIER_TWINS(espalier_sphere, Sphere);
ESPALIER_TWINS(espalier_steps, Steps);
ESPALIER_TWINS(espalier_sweep_hit, SweepHit);
ESPALIER_TWINS(espalier_tree_child, TreeChild);
ESPALIER_TWINS(espalier_tree_node, TreeNode);
ESPALIER_TWINS(espalier_triangle, Triangle);
ESPALIER_TWINS(espalier_triangle_pair, TrianglePair);
ESPALIER_TWINS(espalier_vec3, Vec3);
#undef ESPALIER_TWINS

template <class T>
using Twin = typename TwinOf<T>::Type;

/// The twin in the same place.
template <class T>
Twin<T>* twin(T* value) {
    return reinterpret_cast<Twin<T>*>(value);
}
template <class T>
const Twin<T>* twin(const T* value) {
    return reinterpret_cast<const Twin<T>*>(value);
}

template <class T>
std::span<Twin<T>> twins(T* values, std::size_t count) {
    return {twin(values), count};
}
template <class T>
std::span<const Twin<T>> twins(const T* values, std::size_t count) {
    return {twin(values), count};
}

/// A copy, for what is passed by value.
template <class T>
constexpr Twin<T> twin_value(const T& value) {
    return std::bit_cast<Twin<T>>(value);
}

inline Visit visit_answer(espalier_visit answer) { return answer == ESPALIER_KEEP_GOING ? keep_going : stop; }

/// A filter as the C++ queries take it; a null one lets everything count. It must outlive the call.
struct Filter {
    espalier_triangle_filter function;
    void* user;
    bool operator()(Triangle triangle) const { return function == nullptr || function(triangle.index, user); }
};

}  // namespace espalier::detail
