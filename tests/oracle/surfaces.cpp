#include "surfaces.hpp"

namespace espalier::reference {

std::vector<PointTriangle> source_surface(const tests::Mesh& mesh) {
    std::vector<PointTriangle> surface;
    surface.reserve(mesh.triangles.size());
    for (const TriangleVertices& t : mesh.triangles)
        surface.push_back(
            {to_point(mesh.positions[t[0]]), to_point(mesh.positions[t[1]]), to_point(mesh.positions[t[2]])});
    return surface;
}

PointTriangle world_corners(const tests::DecodedBlob& decoded, const tests::GridTriangle& triangle) {
    const double step = std::ldexp(1.0, decoded.step_exponent);
    const Point origin = to_point(Vec3{decoded.origin[0], decoded.origin[1], decoded.origin[2]});
    const auto world = [&](const tests::GridPoint& q) { return origin + step * to_point(q); };
    return {world(triangle.a), world(triangle.b), world(triangle.c)};
}

std::vector<PointTriangle> baked_surface(std::span<const std::byte> bytes) {
    const tests::DecodedBlob decoded = tests::decode(bytes);
    std::vector<PointTriangle> surface;
    surface.reserve(decoded.triangles.size());
    for (const tests::GridTriangle& t : decoded.triangles) surface.push_back(world_corners(decoded, t));
    return surface;
}

}  // namespace espalier::reference
