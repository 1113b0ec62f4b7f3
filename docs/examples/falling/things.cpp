#include "things.hpp"

#include <array>
#include <stdexcept>

#include <espalier/bake.hpp>

namespace falling {

using namespace espalier;

namespace {

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;

    /// Adds a quadrilateral, counter-clockwise when seen from outside.
    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    }
};

/// A prism: a convex outline, counter-clockwise when seen from above, between two heights.
Mesh make_prism(const std::vector<Vec3>& outline, float bottom, float top) {
    Mesh mesh;
    const auto sides = static_cast<std::uint32_t>(outline.size());
    for (const Vec3& corner : outline) mesh.positions.push_back({corner.x, corner.y, bottom});
    for (const Vec3& corner : outline) mesh.positions.push_back({corner.x, corner.y, top});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides;
        mesh.add_quad(i, next, sides + next, sides + i);
    }
    for (std::uint32_t i = 1; i + 1 < sides; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({sides, sides + i, sides + i + 1});
    }
    return mesh;
}

}  // namespace

Things::Things() {
    const std::vector<Vec3> square = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    const std::vector<Vec3> octagon = {{0.5f, -0.25f, 0}, {0.5f, 0.25f, 0},   {0.25f, 0.5f, 0},   {-0.25f, 0.5f, 0},
                                       {-0.5f, 0.25f, 0}, {-0.5f, -0.25f, 0}, {-0.25f, -0.5f, 0}, {0.25f, -0.5f, 0}};
    const std::vector<Vec3> triangle = {{-0.5f, -0.5f, 0}, {0.75f, -0.5f, 0}, {-0.5f, 0.5f, 0}};
    const std::array<Mesh, 3> made = {make_prism(square, -0.5f, 0.5f), make_prism(octagon, -0.625f, 0.625f),
                                      make_prism(triangle, -0.375f, 0.375f)};
    for (const Mesh& mesh : made) {
        MeshView view;
        view.positions = mesh.positions;
        view.triangles = mesh.triangles;
        const BakeResult baked = bake(std::span(&view, 1), {.resolution = Resolution::step(-10)});
        if (!baked) throw std::runtime_error(baked.message);
        bytes_.push_back(baked.bytes);
        meshes_.push_back(open(bytes_.back()));
    }
}

}  // namespace falling
