// Two blobs: walking both trees changes nothing, on any instruction set.
#include "support/testing.hpp"

#include "placement_check.hpp"
#include "support/queries/placement_maker.hpp"

namespace espalier::tests::pairs_loop_test {
namespace {

enum class Kind { random, apart, adversarial };

Transform make(PlacementMaker& maker, Kind kind) {
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

TestBlob make_test_blob(const Mesh& mesh, const BakeOptions& options) {
    OpenedBlob opened(mesh, options);
    DecodedBlob decoded = decode(opened.bytes);
    return {mesh.name, std::move(opened), std::move(decoded)};
}

/// Long triangles through many small ones, with as many references as splits can make.
TestBlob make_split_blob(std::uint64_t seed) {
    TestBlob blob = make_test_blob(crossed_by_beams(30, 150, seed), with_copies());
    REQUIRE(blob.opened.blob.duplicate_reference_count() > 50);
    return blob;
}

TEST_CASE("pair: duplicate references give each contact once in one order on every path and in pages") {
    PlacementCounts counts;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        std::vector<TestBlob> tests;
        tests.push_back(make_split_blob(2 * seed));
        tests.push_back(make_split_blob(2 * seed + 1));
        for (const Profile other : {Profile::balanced, Profile::tiny})
            tests.push_back(make_test_blob(crossed_by_beams(20, 60, seed), with_profile(other)));
        const std::vector<PairedBlob> blobs(tests.begin(), tests.end());
        for (const auto& [i, j] : {std::pair{0, 1}, {0, 0}, {0, 2}, {2, 0}, {0, 3}, {3, 0}}) {
            const PairedBlob &a = blobs[static_cast<std::size_t>(i)], &b = blobs[static_cast<std::size_t>(j)];
            PlacementMaker maker(a.test.decoded, b.test.decoded, 70 + seed);
            for (std::uint64_t n = 0; n < scaled(8); ++n) {
                const Kind kind = n % 3 == 0 ? Kind::adversarial : n % 3 == 1 ? Kind::random : Kind::apart;
                check_placement(a, b, make(maker, kind), {.distances = true}, counts);
            }
        }
    }
    CHECK(counts.touching > 0);
    CHECK(counts.repeated > 0);
    if (!asks_enough()) return;
    CHECK(counts.touching > 50);
    CHECK(counts.repeated > 100);
}

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

}  // namespace
}  // namespace espalier::tests::pairs_loop_test
