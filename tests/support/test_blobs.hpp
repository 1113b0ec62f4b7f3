// The blobs that most claims about queries are tried on: every mesh maker, several lattices, several places in the
// world, each in every profile. Claims share their scale among the profiles: profiles.hpp.
#pragma once

#include <vector>

#include "baking.hpp"
#include "decoder.hpp"

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

}  // namespace espalier::tests
