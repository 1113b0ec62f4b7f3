// Two blobs, one or both of them read from a file: walking both trees changes nothing, on any instruction set.
#include "support/testing.hpp"

#include "placement_check.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/placement_maker.hpp"

namespace espalier::tests::real_meshes_test {
namespace {

std::vector<TestBlob> bake_in_every_profile(const Mesh& mesh) {
    std::vector<TestBlob> blobs;
    for (const Profile profile : every_profile) {
        OpenedBlob opened(mesh, with_profile(profile));
        DecodedBlob decoded = decode(opened.bytes);
        blobs.push_back({mesh.name + ", profile " + name_of(profile), std::move(opened), std::move(decoded)});
    }
    return blobs;
}

/// `check` takes the mesh's name and a blob of each profile.
template <class Check>
void for_each_mesh(Check check) {
    for_each_mesh_read(
        [&](const Mesh& mesh) {
            const std::vector<TestBlob> tests = bake_in_every_profile(mesh);
            check(mesh.name, std::vector<PairedBlob>(tests.begin(), tests.end()));
        },
        quickly_baked);
}

/// Each profile against the next.
void check_against_itself(const std::string& name, const std::vector<PairedBlob>& blobs) {
    // Loops over pairs take their time: meshes are asked alike long, not alike often.
    const std::uint64_t count =
        scaled_share(std::max<std::uint64_t>(3, 120'000 / blobs.front().test.decoded.triangles.size()));
    constexpr Questions questions = {.distances = true};
    PlacementCounts random, adversarial;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        const PairedBlob& a = blobs[i];
        const PairedBlob& b = blobs[(i + 1) % blobs.size()];
        PlacementMaker maker(a.test.decoded, b.test.decoded, 960 + i);
        for (std::uint64_t n = 0; n < count; ++n) {
            check_placement(a, b, n % 2 == 0 ? maker.random() : maker.apart(), questions, random);
            check_placement(a, b, maker.adversarial(), questions, adversarial);
        }
    }
    tell_calls(name, random, adversarial, true);
}

/// Each profile against every small blob, and the other way round by turns.
void check_against_small(const std::string& name, const std::vector<PairedBlob>& real,
                         const std::vector<PairedBlob>& small) {
    const std::uint64_t count = scaled(3), adversarial_count = std::max<std::uint64_t>(1, scaled(1) / 3);
    constexpr Questions questions = {.distances = true, .paths = AskedPaths::one_by_turns};
    PlacementCounts random, adversarial;
    for (std::size_t i = 0; i < small.size(); ++i)
        for (std::size_t j = 0; j < real.size(); ++j) {
            const bool real_first = (i + j) % 2 == 0;
            const PairedBlob& a = real_first ? real[j] : small[i];
            const PairedBlob& b = real_first ? small[i] : real[j];
            PlacementMaker maker(a.test.decoded, b.test.decoded, 1000 + 8 * i + j);
            // The small one is as large as the real one, or down to a thousandth of it; more often small, which is
            // fast.
            const auto proportion = [&] {
                const int some = maker.numbers().between(0, 10), other = maker.numbers().between(0, 10);
                const int halvings = std::max(some, other);
                return std::ldexp(1.0, real_first ? -halvings : halvings);
            };
            for (std::uint64_t n = 0; n < count; ++n) {
                // Of equal sizes they touch in thousands of pairs, or much of the one is as far from the other: slow.
                const std::uint32_t kind = maker.numbers().below(64);
                const Transform placement = kind == 0   ? maker.random()
                                            : kind == 1 ? maker.apart()
                                                        : maker.beside(proportion());
                check_placement(a, b, placement, questions, random);
            }
            for (std::uint64_t n = 0; n < adversarial_count; ++n)
                check_placement(a, b, (i / 2 + j + n) % 2 == 0 ? maker.face_on_face(proportion()) : maker.adversarial(),
                                questions, adversarial);
        }
    tell_calls(name, random, adversarial, true);
    if (!asks_enough()) return;
    for (const PlacementCounts& counts : {random, adversarial}) {
        CHECK(counts.touching > counts.asked / 10);
        CHECK(counts.distances > counts.asked / 20);
    }
}

TEST_CASE("pair: two real meshes have the contacts and the distance of the loop") {
    for_each_mesh(check_against_itself);
}

TEST_CASE("pair: a real mesh and small awkward ones have the contacts and the distance of the loop") {
    const std::vector<PairedBlob> small(small_test_blobs().begin(), small_test_blobs().end());
    for_each_mesh(
        [&](const std::string& name, const std::vector<PairedBlob>& real) { check_against_small(name, real, small); });
}

}  // namespace
}  // namespace espalier::tests::real_meshes_test
