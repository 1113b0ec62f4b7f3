// Claims about what an opened blob contains: its properties and its triangles.
#include "support/testing.hpp"

#include "every_triangle.hpp"

namespace espalier::tests::contents_test {
namespace {

TEST_CASE("walk: every triangle comes in storage order with the corners of the decoder") {
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        const double step = std::ldexp(1.0, blob.decoded.step_exponent);
        const std::vector<Triangle> triangles = every_triangle(blob.opened.blob);
        REQUIRE(triangles.size() == blob.decoded.triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const GridTriangle& expected = blob.decoded.triangles[i];
            const auto check = [&](Vec3 corner, const GridPoint& grid) {
                const float given[3] = {corner.x, corner.y, corner.z};
                for (unsigned k = 0; k < 3; ++k) {
                    const double exact = static_cast<double>(blob.decoded.origin[k]) + grid[k] * step;
                    REQUIRE(given[k] == static_cast<float>(exact));
                }
            };
            check(triangles[i].a, expected.a);
            check(triangles[i].b, expected.b);
            check(triangles[i].c, expected.c);
        }
        int calls = 0;
        const auto stop = [&](TriangleId, const Triangle&) { return ++calls, Visit::stop; };
        CHECK(for_each_triangle(blob.opened.blob, stop) == QueryStatus::stopped);
        CHECK(calls == 1);
    }
}

TEST_CASE("open: the properties of a blob equal its header") {
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        const Blob& view = blob.opened.blob;
        CHECK(view.triangle_count() == blob.decoded.triangle_count);
        CHECK(view.vertex_count() == distinct_corners(blob.decoded).size());
        CHECK(view.size() == blob.opened.bytes.size());
        CHECK(detail::data_of(view).bits == blob.decoded.bits);
        CHECK(view.depth() == blob.decoded.depth);
        CHECK(view.lattice().step_exponent == blob.decoded.step_exponent);
        CHECK(view.max_error() == blob.decoded.max_error);
        CHECK(view.bounds().min == Vec3{blob.decoded.origin[0], blob.decoded.origin[1], blob.decoded.origin[2]});
        unsigned deepest = 0;
        for (const DecodedNode& node : blob.decoded.nodes) deepest = std::max(deepest, node.depth);
        CHECK(view.depth() == deepest);
    }
    const Blob empty;
    CHECK(empty.triangle_count() == 0);
    CHECK(empty.bounds().min == Vec3{});
    CHECK(empty.bounds().max == Vec3{});
    CHECK(for_each_triangle(empty, [](TriangleId) { return Visit::stop; }) == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::contents_test
