// The blobs that most claims about queries are tried on: every mesh maker, several lattices, several places in the
// world, each in every profile. Claims share their scale among the profiles: profiles.hpp.
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "baking.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

struct TestBlob {
    std::string name;
    OpenedBlob opened;
    DecodedBlob decoded;
};

/// At most 1,000 triangles each.
const std::vector<TestBlob>& small_test_blobs();
/// Some thousand triangles each.
const std::vector<TestBlob>& medium_test_blobs();

/// A sphere of 320 triangles with every optional section; the material of each is its number.
std::vector<std::byte> make_blob_with_every_section(Profile profile);

/// Calls ask(blob, maker, i) for each blob and i below `count`, with a maker of queries about the blob.
template <class Maker, class Ask>
void ask_each(const std::vector<TestBlob>& blobs, std::uint64_t seed, std::uint64_t count, const Ask& ask) {
    for (const TestBlob& blob : blobs) {
        CAPTURE(blob.name);
        Maker maker(blob.decoded, seed);
        for (std::uint64_t i = 0; i < count; ++i) ask(blob, maker, i);
    }
}

}  // namespace espalier::tests
