// Claims that the structures, enumerations and numbers of espalier.h are those of the C++ headers. Most of them the
// compiler checks.
#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include <c99.h>

#include <runtime/c/abi.hpp>

#include <espalier/format.hpp>

namespace espalier::detail {

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
#define SAME_VALUE(c, cpp) static_assert(int{c} == static_cast<int>(cpp))
#define SAME_SIZE(c, Cpp) static_assert(sizeof(c) == sizeof(Cpp))

#include <layouts.inc>

static_assert(offsetof(DistanceBounds, lower) == 0 && offsetof(DistanceBounds, upper) == sizeof(float));
static_assert(sizeof(RayHit) == 32 && sizeof(ClosestPoint) == 56 && sizeof(Contact) == 36);
static_assert(sizeof(SweepHit) == 48 && sizeof(LatticeHit) == 12);

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

TEST_CASE("c api: a compiler of C lays out the structures as one of C++ does") {
    const std::size_t in_cpp[] = {LAYOUTS_};
    for (std::size_t i = 0; i < std::size(in_cpp); ++i) CHECK(c99_layouts[i] == in_cpp[i]);
}

TEST_CASE("c api: espalier_abi has the size of every structure") {
#define NAME(name, Cpp) #name,
    const std::set<std::string> listed = {ESPALIER_C_STRUCTURES(NAME, NAME)}, declared = {STRUCTURES_};
#undef NAME
    CHECK(listed == declared);
    // espalier_abi() fills in a field for each that is listed: there are no others.
    CHECK(sizeof(espalier_abi_sizes) == (3 + listed.size()) * sizeof(std::uint16_t));
    const espalier_abi_sizes sizes = c99_abi();
    CHECK(sizes.version_major == espalier::library_version_major);
    CHECK(sizes.version_minor == espalier::library_version_minor);
    CHECK(sizes.version_patch == espalier::library_version_patch);
#define SIZE(name, Cpp) CHECK(sizes.name == sizeof(espalier_##name));
    ESPALIER_C_STRUCTURES(SIZE, SIZE)
#undef SIZE
}

TEST_CASE("c api: a loaded library has its version and the size of each structure by name") {
    CHECK(std::string(c99_version()) == ESPALIER_VERSION);
#define SIZE(name, Cpp) CHECK(c99_size_of(#name) == sizeof(espalier_##name));
    ESPALIER_C_STRUCTURES(SIZE, SIZE)
#undef SIZE
    for (const char* const other : {"", "blo", "blobs", "espalier_blob", "mesh_view", "Blob"})
        CHECK_MESSAGE(c99_size_of(other) == 0, other);
    CHECK(c99_size_of(nullptr) == 0);
}
