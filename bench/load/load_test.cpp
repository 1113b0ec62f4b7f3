// What is decoded is the mesh that was encoded, and all ways answer rays alike.

#include <doctest/doctest.h>

#include "../study/walks.hpp"
#include "ways.hpp"

namespace espalier::bench {
namespace {

std::vector<Mesh> some_meshes() {
    return {tests::make_icosphere(3, 1.0, {0.3f, 0.2f, 0.1f}), tests::make_torus(40, 12, 1.0, 0.3),
            tests::make_soup(300, 1), tests::make_cube(-1.0f, 2.0f)};
}

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;

/// Returns the triangles in ascending order, each from its least corner on: the order of triangles, and which corner
/// comes first, may change.
std::vector<Corners> canonical(const Mesh& mesh) {
    std::vector<Corners> triangles;
    for (const TriangleVertices& t : mesh.triangles) {
        Corners corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& p = mesh.positions[t[i]];
            corners[i] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        triangles.push_back(corners);
    }
    std::ranges::sort(triangles);
    return triangles;
}

TEST_CASE("bench: a file of floats is the mesh") {
    for (const Mesh& mesh : some_meshes())
        CHECK(canonical(decoded(write_floats(mesh), read_floats)) == canonical(mesh));
}

#ifdef ESPALIER_BENCH_MESHOPT
TEST_CASE("bench: meshoptimizer decodes exactly the triangles that lie on the lattice") {
    for (const Mesh& mesh : some_meshes()) {
        const SnappedMesh snapped = snap_mesh(mesh);
        const Mesh read = decoded(write_meshopt(snapped), read_meshopt);
        CHECK(canonical(read) == canonical(snapped.mesh));
        // Vertices of triangles that collapsed are not written.
        CHECK(read.positions.size() <= snapped.mesh.positions.size());
    }
}

TEST_CASE("bench: damaged streams of meshoptimizer are refused") {
    const Bytes file = write_meshopt(snap_mesh(tests::make_icosphere(2, 1.0, {})));
    const Bytes shorter(file.begin(), file.end() - 1);
    CHECK_THROWS(static_cast<void>(decoded(shorter, read_meshopt)));
}
#endif

TEST_CASE("bench: every way to load a mesh answers rays as the loop over its triangles") {
    for (const Mesh& mesh : some_meshes()) {
        const Mesh snapped = snap_mesh(mesh).mesh;
        const std::vector<Ray> rays = incoherent_rays(mesh, 300, 5);
        for (const Way& way : all_ways(mesh)) {
            CAPTURE(way.ships);
            CAPTURE(way.loads);
            const std::unique_ptr<Loaded> loaded = way.load(way.file);
            CHECK(loaded->bytes() > 0);
            const std::vector<FloatTriangle> shipped = triangles_of(way.ships == "floats" ? mesh : snapped);
            for (const Ray& ray : rays) {
                const double expected = closest_of_all(shipped, ray);
                const auto t = static_cast<double>(loaded->closest(ray));
                CHECK((t == expected || std::abs(t - expected) < 1e-3));
            }
        }
    }
}

TEST_CASE("bench: what is deflated inflates to the same bytes") {
    const Bytes file = write_floats(tests::make_icosphere(3, 1.0, {}));
    const auto deflated = deflate_bytes(file);
    if (!deflated) return;
    CHECK(deflated->size() < file.size());
    CHECK(inflate_bytes(*deflated, file.size()) == file);
    CHECK_THROWS(static_cast<void>(inflate_bytes(std::span(*deflated).first(deflated->size() / 2), file.size())));
}

}  // namespace
}  // namespace espalier::bench
