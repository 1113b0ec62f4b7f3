// Meshes of 0 to 16 triangles, all of them that a few shapes make.
#include "support/testing.hpp"

#include "baking_support.hpp"
#include "support/base/sanitized.hpp"

namespace espalier::tests::few_triangles_test {
namespace {

/// Two neighbours, the first one's back, one that crosses it, a needle, and one without area.
constexpr std::array<std::array<Vec3, 3>, 6> kinds = {{
    {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}},
    {{{4, 0, 0}, {4, 4, 0}, {0, 4, 0}}},
    {{{0, 0, 0}, {0, 4, 0}, {4, 0, 0}}},
    {{{1, 1, -1}, {1, 1, 3}, {3, 1, 1}}},
    {{{0, 0, 4}, {4, 4, 4}, {4, 4, 3.999f}}},
    {{{2, 2, 2}, {2, 2, 2}, {1, 1, 1}}},
}};
using Counts = std::array<unsigned, kinds.size()>;

/// Copies in reverse order, so that equal ones are not next to each other.
Mesh mesh_of(const Counts& counts) {
    Mesh mesh;
    const unsigned most = *std::max_element(counts.begin(), counts.end());
    for (unsigned copy = most; copy > 0; --copy) {
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            if (counts[kind] < copy) continue;
            append_triangle(mesh, kinds[kind][0], kinds[kind][1], kinds[kind][2]);
        }
    }
    return mesh;
}

/// Calls with every way of sharing `left` triangles and fewer among the kinds from this one on.
template <class Call>
void for_each_multiset(Counts& counts, std::size_t kind, unsigned left, const Call& call) {
    if (kind == kinds.size()) return call(counts);
    for (counts[kind] = 0; counts[kind] <= left; ++counts[kind])
        for_each_multiset(counts, kind + 1, left - counts[kind], call);
    counts[kind] = 0;
}

/// 16 of a grid of squares, whichever of them are there.
Mesh some_of_a_grid(unsigned which) {
    Mesh mesh;
    for (unsigned y = 0; y < 4; ++y)
        for (unsigned x = 0; x < 4; ++x) mesh.positions.push_back({float(x), float(y), float((x * y) % 3)});
    for (std::uint32_t i = 0; i < 16; ++i) {
        if ((which >> i & 1u) == 0) continue;
        const std::uint32_t square = i / 2, at = square / 3 * 4 + square % 3;
        mesh.triangles.push_back(i % 2 == 0 ? TriangleVertices{at, at + 1, at + 5}
                                            : TriangleVertices{at, at + 5, at + 4});
    }
    return mesh;
}

TEST_CASE("weld: every mesh of up to 16 triangles of six kinds keeps one of each kind and counts the rest") {
    Counts counts{};
    std::uint64_t meshes = 0;
    for_each_multiset(counts, 0, 16, [&](const Counts& some) {
        CAPTURE(meshes);
        if (meshes % (takes_every_case() ? sanitized ? 16 : 1 : 61) != 0) return void(++meshes);
        const Mesh mesh = mesh_of(some);
        const auto result = must_bake_mesh(mesh, with_profile(every_profile[meshes++ % every_profile.size()]));
        REQUIRE(verify(result.bytes));
        std::uint64_t kept = 0;
        for (std::size_t kind = 0; kind + 1 < some.size(); ++kind) kept += some[kind] != 0 ? 1u : 0u;
        REQUIRE(result.report.tree.triangles == kept);
        REQUIRE(result.report.findings.zero_area.count == some.back());
        REQUIRE(result.report.findings.duplicate.count == mesh.triangles.size() - kept - some.back());
    });
    CHECK(meshes == 74'613);  // 22 over 6
}

TEST_CASE("baker: every choice among 16 triangles of a grid gives a sound blob of those triangles") {
    // Up to 16 triangles that are all kept, in leaves of any number: 2^16 meshes.
    const unsigned stride = takes_every_case() ? sanitized ? 17 : 1 : 61;
    for (unsigned which = 0; which < 1u << 16; which += stride) {
        const Mesh mesh = some_of_a_grid(which);
        const auto result = must_bake_mesh(mesh, with_profile(every_profile[which % every_profile.size()]));
        CAPTURE(which);
        REQUIRE(result.report.tree.triangles == mesh.triangles.size());
        REQUIRE(verify(result.bytes));
    }
}

}  // namespace
}  // namespace espalier::tests::few_triangles_test
