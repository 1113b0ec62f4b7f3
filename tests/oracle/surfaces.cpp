#include "surfaces.hpp"

#include "support/format/decoder.hpp"

namespace espalier::reference {

std::vector<PointTriangle> source_surface(const tests::Mesh& mesh) {
    std::vector<PointTriangle> surface;
    surface.reserve(mesh.triangles.size());
    for (const TriangleVertices& t : mesh.triangles)
        surface.push_back(
            {to_point(mesh.positions[t[0]]), to_point(mesh.positions[t[1]]), to_point(mesh.positions[t[2]])});
    return surface;
}

std::vector<PointTriangle> baked_surface(std::span<const std::byte> bytes) {
    const tests::DecodedBlob decoded = tests::decode(bytes);
    const double step = std::ldexp(1.0, decoded.step_exponent);
    const Point origin = to_point({decoded.origin[0], decoded.origin[1], decoded.origin[2]});
    const auto world = [&](const tests::GridPoint& q) {
        return origin + step * Point{static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2])};
    };
    std::vector<PointTriangle> surface;
    surface.reserve(decoded.triangles.size());
    for (const tests::GridTriangle& t : decoded.triangles) surface.push_back({world(t.a), world(t.b), world(t.c)});
    return surface;
}

}  // namespace espalier::reference
