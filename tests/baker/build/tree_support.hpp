// Meshes on their lattice that are hard on builders, and what a binary tree must be.
#pragma once

#include "support/testing.hpp"

#include <baker/build/binary_tree.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::tests {

inline void add_triangle(baker::LatticeMesh& mesh, const LatticePoint& a, const LatticePoint& b,
                         const LatticePoint& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({{first, first + 1, first + 2}, static_cast<std::uint32_t>(mesh.triangles.size())});
}

/// Triangles of many sizes in a cube, which no heuristic that only splits gets right.
inline baker::LatticeMesh mixed_sizes(std::uint32_t count, std::uint64_t seed) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 16;
    Random random(seed);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::int32_t size = 10 << random.below(10);
        const auto from = [&] { return random.between(0, 65'535 - size); };
        const LatticePoint a = {from(), from(), from()};
        const auto near = [&](std::int32_t coordinate) { return coordinate + random.between(0, size); };
        const LatticePoint b = {near(a.x), near(a.y), near(a.z)};
        const LatticePoint c = {near(a.x), near(a.y), near(a.z)};
        add_triangle(mesh, a, b, c);
    }
    return mesh;
}

/// Large triangles whose boxes are nearly the same: every split costs about the same, and the surface area heuristic
/// likes to part with them one by one.
inline baker::LatticeMesh nearly_equal_boxes(std::uint32_t count) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 24;
    Random random(1);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto jitter = [&] { return random.between(0, 40'000); };
        const LatticePoint a = {jitter(), jitter(), jitter()};
        const LatticePoint b = {16'000'000 + jitter(), 16'000'000 + jitter(), jitter()};
        const LatticePoint c = {jitter(), 16'000'000 + jitter(), 16'000'000 + jitter()};
        add_triangle(mesh, a, b, c);
    }
    return mesh;
}

/// The same triangle again and again.
inline baker::LatticeMesh identical_triangles(std::uint32_t count) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 16;
    for (std::uint32_t i = 0; i < count; ++i) add_triangle(mesh, {10, 20, 30}, {1000, 20, 40}, {10, 2000, 50});
    return mesh;
}

/// Around one centre, of all sizes.
inline baker::LatticeMesh concentric_triangles(std::uint32_t count) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 24;
    constexpr std::int32_t middle = 1 << 23;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::int32_t size = static_cast<std::int32_t>(i) * 80 + 1;
        add_triangle(mesh, {middle - size, middle - size, middle - size}, {middle + size, middle + size, middle - size},
                     {middle - size, middle + size, middle + size});
    }
    return mesh;
}

/// Stairs up a corner of the lattice, step i twice as large and twice as far as step i - 1, `copies` triangles on each.
inline baker::LatticeMesh exponential_stairs(std::uint32_t copies) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 24;
    for (int step = 0; step < 23; ++step) {
        const std::int32_t size = 1 << step;
        for (std::uint32_t i = 0; i < copies; ++i)
            add_triangle(mesh, {size, 0, size}, {2 * size, 0, size}, {size, size, size});
    }
    return mesh;
}

/// The triangles of a lattice mesh in the world.
inline Mesh as_mesh(const baker::LatticeMesh& lattice_mesh) {
    Mesh mesh;
    for (const LatticePoint& point : lattice_mesh.vertices) {
        mesh.positions.push_back(
            {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)});
    }
    for (const baker::LatticeTriangle& triangle : lattice_mesh.triangles) mesh.triangles.push_back(triangle.corners);
    return mesh;
}

/// Requires that there is each triangle once.
inline void require_each_once(std::vector<std::uint32_t> triangles, std::size_t count) {
    std::ranges::sort(triangles);
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    REQUIRE(triangles == all);
}

/// Height of the subtree, having checked that it lies together and that its box is the one around its children.
inline unsigned checked_height(const baker::BinaryTree& tree, std::size_t node) {
    const baker::BinaryNode& here = tree.nodes[node];
    if (here.is_leaf()) return 0;
    const std::size_t left_at = baker::BinaryTree::left_of(node);
    const std::size_t right_at = tree.right_of(node);
    const baker::BinaryNode& left = tree.nodes[left_at];
    const baker::BinaryNode& right = tree.nodes[right_at];
    bool is_sound = left.count + right.count == here.count && left.first == here.first &&
                    right.first == here.first + left.count && left.count > 0 && right.count > 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        is_sound = is_sound && here.lo[axis] == std::min(left.lo[axis], right.lo[axis]) &&
                   here.hi[axis] == std::max(left.hi[axis], right.hi[axis]);
    }
    REQUIRE(is_sound);
    return 1 + std::max(checked_height(tree, left_at), checked_height(tree, right_at));
}

}  // namespace espalier::tests
