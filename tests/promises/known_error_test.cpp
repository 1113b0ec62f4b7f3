// P3: the baked surface differs from its source by at most max_error, by a distance that is found between bounds.
#include "support/testing.hpp"

#include "../oracle/double_tree.hpp"
#include "../oracle/hausdorff.hpp"
#include "../oracle/surfaces.hpp"

namespace espalier::tests::known_error_test {
namespace {

using namespace espalier::reference;

TEST_CASE("error: no point of either surface is farther from the other than max_error") {
    const tests::Mesh meshes[] = {tests::make_icosphere(3, 3.0, {1.0f, 2.0f, 3.0f}),
                                  tests::make_terrain(20, 3),
                                  tests::make_soup(200, 7),
                                  tests::make_uv_sphere(24, 30, 2.0, {}),
                                  tests::make_needle_fan(50),
                                  tests::make_slivers(100, 2),
                                  tests::make_torus(40, 20, 3.0, 1.0),
                                  tests::make_plane_grid(11)};
    std::size_t dropped = 0;
    for (const tests::Mesh& mesh : meshes) {
        const DoubleTree source(source_surface(mesh));
        for (const unsigned bits : {3u, 4u, 5u, 6u, 8u, 10u, 13u, 16u, 20u}) {
            const tests::OpenedBlob opened(mesh, {.resolution = Resolution::bits(bits)});
            if (opened.blob.triangle_count() == 0) continue;
            CAPTURE(bits);
            const DoubleTree baked(baked_surface(opened.bytes));
            dropped += mesh.triangles.size() - baked.triangles().size();
            const double allowed = static_cast<double>(opened.blob.max_error());
            CHECK(one_way_distance(source, baked, 5000).lower <= allowed);
            CHECK(one_way_distance(baked, source, 5000).lower <= allowed);
        }
    }
    CHECK(dropped > 1000);  // what collapsed counts too
}

}  // namespace
}  // namespace espalier::tests::known_error_test
