// Arguments of C as C++ takes them, and results of C++ as C has them. By other means than lib/runtime/c, whose mistakes
// would else be made twice.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <runtime/c/abi.hpp>

namespace espalier::tests {

using detail::Twin;

/// Returns an argument that C passes by its address: the same object.
template <class Cpp, class C>
auto& to(C* object) requires(std::is_same_v<Twin<std::remove_const_t<C>>, Cpp>) {
    return *reinterpret_cast<std::conditional_t<std::is_const_v<C>, const Cpp, Cpp>*>(object);
}
/// Returns an argument that C passes by its value.
template <class Cpp, class C>
Cpp to(const C& value) requires(!std::is_pointer_v<C>) {
    return std::bit_cast<Cpp>(value);
}
template <class Cpp, class C>
Cpp* pointer_to(C* object) {
    return reinterpret_cast<Cpp*>(object);
}
template <class Cpp, class C>
std::span<Cpp> spanned(C* first, std::size_t count) {
    return {reinterpret_cast<Cpp*>(first), count};
}
inline auto& rows_of(const float* numbers) { return *reinterpret_cast<const float(*)[3][4]>(numbers); }

template <class Cpp>
ConvexVolume to(const espalier_convex_volume* volume) requires(std::is_same_v<Cpp, ConvexVolume>) {
    return {spanned<const Plane>(volume->planes, volume->plane_count)};
}
template <class Cpp>
ConvexHull to(const espalier_convex_hull* hull) requires(std::is_same_v<Cpp, ConvexHull>) {
    return {spanned<const Vec3>(hull->vertices, hull->vertex_count)};
}
template <class Cpp>
PlacedBlob to(const espalier_placed_blob* placed) requires(std::is_same_v<Cpp, PlacedBlob>) {
    return {to<Blob>(placed->blob), to<Transform>(&placed->transform)};
}

/// Returns what C++ passes to a callback as C does.
inline espalier_triangle_id passed(TriangleId triangle) { return triangle.index; }
inline espalier_instance_id passed(InstanceId instance) { return {instance.index, instance.in_tile}; }
template <class Cpp>
const Twin<Cpp>* passed(const Cpp& object) {
    return reinterpret_cast<const Twin<Cpp>*>(&object);
}

/// A filter of C; null keeps all.
template <class Filter>
struct Keeps {
    Filter filter;
    void* user;
    bool operator()(const auto&... found) const { return filter == nullptr || filter(passed(found)..., user); }
};

/// A visitor of C, which any number stops that Answer does not have.
template <class Answer, class Visitor>
struct Visits {
    Visitor visit;
    void* user;
    Answer operator()(const auto&... found) const {
        const int answer = visit(passed(found)..., user);
        if (answer == 0) return Answer{0};
        return answer == 1 ? Answer{1} : Answer::stop;
    }
};

/// Options with a filter, which must outlive those of C++.
template <class Cpp>
struct Options {
    Keeps<espalier_triangle_filter> keep;
    const espalier_sweep_options& in_c;
    operator SweepOptions() const {  // NOLINT(google-explicit-constructor): an argument
        return {keep, FaceCulling{in_c.culling}, in_c.ignore_leaving, in_c.skin};
    }
};
template <>
struct Options<SceneSweepOptions> {
    std::uint32_t mask;
    Keeps<espalier_scene_filter> keep;
    const espalier_scene_sweep_options& in_c;
    operator SceneSweepOptions() const {  // NOLINT(google-explicit-constructor): an argument
        return {{mask, keep}, FaceCulling{in_c.culling}, in_c.ignore_leaving, in_c.skin};
    }
};
template <>
struct Options<PairFilter> {
    bool only_moved;
    Keeps<espalier_pair_keep> keep;
    operator PairFilter() const { return {only_moved, keep}; }  // NOLINT(google-explicit-constructor): an argument
};
template <class Cpp>
Options<Cpp> to(const espalier_sweep_options* options) requires(std::is_same_v<Cpp, SweepOptions>) {
    return {{options->filter, options->user}, *options};
}
template <class Cpp>
Options<Cpp> to(std::uint32_t mask, const espalier_scene_sweep_options* options) {
    return {mask, {options->filter, options->user}, *options};
}
template <class Cpp>
Options<Cpp> to(const espalier_pair_filter* filter) requires(std::is_same_v<Cpp, PairFilter>) {
    if (filter == nullptr) return {false, {nullptr, nullptr}};
    return {filter->only_moved, {filter->keep, filter->user}};
}

/// Returns a result as C has it.
template <class C, class Cpp>
C from_cpp(const Cpp& result) {
    if constexpr (std::is_pointer_v<C> && !std::is_pointer_v<Cpp>) return reinterpret_cast<C>(&result);
    else if constexpr (std::is_class_v<Cpp>) return std::bit_cast<C>(result);
    else return static_cast<C>(result);
}

}  // namespace espalier::tests
