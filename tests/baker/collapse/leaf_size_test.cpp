// The sizes of leaves that the builder plans with, against leaves as they are stored.
#include "support/testing.hpp"

#include <baker/collapse/leaf_size.hpp>

#include "support/format/encoder.hpp"

namespace espalier::tests::leaf_size_test {
namespace {

TEST_CASE("builder: a plain leaf is planned with as many bytes as are stored") {
    for (const unsigned bits : {1u, 16u, 17u, 24u}) {
        const auto sizes = baker::leaf_sizes(Profile::fast, bits, nullptr);
        for (unsigned vertices = 1; vertices <= 32; ++vertices) {
            for (unsigned triangles = 1; triangles <= sizes->most_triangles(); ++triangles) {
                PlainBlob blob;
                blob.decoded.profile = Profile::fast;
                blob.decoded.bits = bits;
                PlainLeaf leaf;
                leaf.vertices.resize(vertices);
                leaf.triangles.resize(triangles);
                blob.nodes.resize(1);
                blob.nodes[0].children = {{{}, {}, 0, leaf}};
                baker::BinaryNode node{};
                node.count = triangles;
                const baker::LeafSize planned = sizes->of(node, vertices);
                REQUIRE(planned.fits);
                REQUIRE(planned.slots == triangles);
                REQUIRE(planned.bytes == get(encode(blob), format::header::leaf_bytes_at, 4));
            }
        }
        CHECK_FALSE(sizes->of({}, 33).fits);
    }
}

}  // namespace
}  // namespace espalier::tests::leaf_size_test
