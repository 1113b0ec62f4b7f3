// Two blobs: walking both trees changes nothing, on any instruction set.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "placement_check.hpp"
#include "support/base/calls.hpp"
#include "support/base/profiles.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/queries/placement_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

enum class Kind { random, apart, adversarial };

Placement make(PlacementMaker& maker, Kind kind) {
    return kind == Kind::random ? maker.random() : kind == Kind::apart ? maker.apart() : maker.adversarial();
}

void check_blobs(const std::vector<TestBlob>& tests, std::uint64_t count, Kind kind, bool with_distance) {
    const std::vector<PairedBlob> blobs(tests.begin(), tests.end());
    PlacementCounts counts;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        // Each with another mesh, and with itself.
        for (const std::size_t j : {(i + 4) % blobs.size(), i}) {
            PlacementMaker maker(blobs[i].test.decoded, blobs[j].test.decoded, 900 + i);
            for (std::uint64_t n = 0; n < count; ++n)
                check_placement(blobs[i], blobs[j], make(maker, kind), {.distances = with_distance}, counts);
        }
    }
    const bool is_adversarial = kind == Kind::adversarial;
    tell_calls(generated_meshes, is_adversarial ? PlacementCounts{} : counts,
               is_adversarial ? counts : PlacementCounts{}, with_distance);
    if (!asks_enough()) return;
    CHECK(counts.touching > counts.asked / 20);
    CHECK(counts.touching < counts.asked);
    CHECK(counts.refused < counts.asked / 10);
}

}  // namespace

TEST_SUITE("collide loop") {
    TEST_CASE("pair: random placements give all contacts in one order on every path") {
        check_blobs(small_test_blobs(), scaled_share(30), Kind::random, false);
    }
    TEST_CASE("pair: touching and coplanar and extreme placements give all contacts on every path") {
        check_blobs(small_test_blobs(), scaled_share(30), Kind::adversarial, false);
    }
    TEST_CASE("pair: separate placements give the smallest distance and all pairs within a distance") {
        check_blobs(small_test_blobs(), scaled_share(6), Kind::apart, true);
    }
    TEST_CASE("pair: nearly touching placements give the smallest distance and all pairs within one") {
        check_blobs(small_test_blobs(), scaled_share(6), Kind::adversarial, true);
    }
}
