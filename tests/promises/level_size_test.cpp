// What a level costs in flash, the blob alone. tests/firmware runs it on a Cortex-M0; docs/small_cores.md adds code and
// stack.
#include "support/testing.hpp"

#include "support/meshes/level_maker.hpp"

namespace espalier::tests::level_size_test {
namespace {

TEST_CASE("promise: a level of 5000 triangles takes at most 24 KB in profile small on 14 bits") {
    for (const std::uint64_t seed : {2026u, 1u, 2u, 3u}) {  // whichever level it is
        const BakeOptions options = {.resolution = Resolution::bits(14), .profile = Profile::small};
        const OpenedBlob level(make_level(5000, seed), options);
        CAPTURE(seed);
        CHECK(level.blob.triangle_count() >= 5000);
        CHECK(level.bytes.size() <= 24 * 1024);
        MESSAGE(level.blob.triangle_count(), " triangles, ", level.bytes.size(), " bytes");
    }
}

}  // namespace
}  // namespace espalier::tests::level_size_test
