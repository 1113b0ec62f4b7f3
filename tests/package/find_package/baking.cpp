// A program that bakes what it has at hand.
#include <array>
#include <cstdio>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

int main() {
    const std::array<espalier::Vec3, 3> positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const std::array<espalier::TriangleVertices, 1> triangles = {{{0, 1, 2}}};
    espalier::MeshView mesh;
    mesh.positions = positions;
    mesh.triangles = triangles;
    mesh.name = "one";
    const auto baked = espalier::bake(std::array{mesh}, {});
    if (!baked) return 1;
    const espalier::Blob blob = espalier::open(baked.bytes);
    if (!blob) return 1;
    std::printf("baked %u triangle\n", static_cast<unsigned>(blob.triangle_count()));
    return 0;
}
