// Claims about the map of copies: who each storage index belongs to.
#include "support/testing.hpp"

#include <runtime/blob/duplicate_references.hpp>

#include "support/format/encoder.hpp"
#include "support/machine/guarded_pages.hpp"

namespace espalier::tests::blob_duplicate_references_test {
namespace {

/// Of one leaf after the other, 16 triangles each, all alike.
PlainBlob make_blob(std::uint32_t leaves) {
    PlainBlob blob;
    blob.decoded.bits = 4;
    blob.decoded.extent.fill(15);
    blob.decoded.vertex_count = 3;
    PlainLeaf leaf;
    leaf.vertices = {{0, 0, 0}, {15, 15, 0}, {0, 15, 15}};
    leaf.triangles.assign(16, {0, 1, 2});
    blob.nodes.resize(1 + (leaves + 7) / 8);
    for (std::size_t node = 1; node < blob.nodes.size(); ++node)
        blob.nodes[0].children.push_back({{0, 0, 0}, {15, 15, 15}, node, {}});
    for (std::uint32_t i = 0; i < leaves; ++i)
        blob.nodes[1 + i / 8].children.push_back({{0, 0, 0}, {15, 15, 15}, 0, leaf});
    return blob;
}

TEST_CASE("spatial split: every storage index leads to its owner for any map of copies") {
    // Whole blocks of 256 and a part of one; the blob's memory ends with its last owner.
    for (const std::uint32_t leaves : {1u, 2u, 15u, 16u, 17u, 48u, 64u}) {
        for (const std::uint32_t one_in : {1u, 2u, 7u, 300u}) {
            CAPTURE(leaves);
            CAPTURE(one_in);
            PlainBlob plain = make_blob(leaves);
            Random random(leaves * 1000 + one_in);
            auto& owners = plain.decoded.owners;
            for (std::uint32_t i = 0; i < 16 * leaves; ++i) {
                const std::uint32_t other = i == 0 ? 0 : random.below(i);
                const bool is_copy = i == 16 * leaves - 1 || random.below(one_in) == 0;
                owners.push_back(is_copy ? (owners.empty() ? 0 : owners[other]) : i);
            }
            plain.decoded.features = format::feature::split_references;
            const GuardedPages pages(encode(plain), true);
            const Blob blob = open(pages.bytes());
            REQUIRE(blob);
            for (std::uint32_t i = 0; i < 16 * leaves; ++i) {
                REQUIRE(detail::owner_of(detail::data_of(blob), i) == owners[i]);
                REQUIRE(detail::is_duplicate_reference(detail::data_of(blob), i) == (owners[i] != i));
            }
        }
    }
}

}  // namespace
}  // namespace espalier::tests::blob_duplicate_references_test
