// Claims about blobs that follow the format and that no baker would make.
#include "support/testing.hpp"

#include <runtime/base/options.hpp>

#include "support/answers/differences.hpp"
#include "support/answers/loop_answers.hpp"
#include "support/answers/path_answers.hpp"
#include "support/blobs/soundness.hpp"
#include "support/blobs/weird_blobs.hpp"
#include "support/exercise/exercise.hpp"
#include "support/machine/exact_buffer.hpp"

namespace espalier::tests::weird_blob_test {
namespace {

TEST_CASE("format: any blob that follows the rules opens and equals the loop over its triangles") {
    std::uint64_t sound = 0, hits = 0;
    std::set<std::uint32_t> features, depths, leaf_sizes;
    const std::uint64_t count = scaled(400);
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const ExactBuffer buffer(encode(make_weird_blob(random)), seed % 16);
        const Blob blob = open(buffer.bytes());
        REQUIRE(blob);
        const bool is_this_sound = is_sound(buffer.bytes());
        REQUIRE_NOTHROW(exercise(blob, random, 1, is_this_sound));
        require_none(path_difference(blob, random, is_this_sound));
        features.insert(detail::data_of(blob).features);
        depths.insert(blob.depth());
        if (!is_this_sound || blob.triangle_count() == 0) continue;
        ++sound;
        const DecodedBlob decoded = decode(buffer.bytes());
        for (const std::uint8_t size : decoded.triangles_in_leaf) leaf_sizes.insert(size);
        const TriangleLoop loop(decoded);
        QueryMaker maker(decoded, seed);
        for (int i = 0; i < 4; ++i) {
            require_none(ray_difference(blob, loop, maker.any_ray(), hits));
            require_none(sphere_difference(blob, loop, maker.sphere(), hits));
        }
        ShapeMaker shapes(decoded, seed);
        SweepMaker sweeps(decoded, seed);
        for (int i = 0; i < 2; ++i) {
            require_none(loop_difference(blob, loop, shapes, sweeps));
        }
    }
    MESSAGE(sound, " of ", count, " sound, ", hits, " hits");
    CHECK(sound > count / 4);
    CHECK(hits > count);
    if (count < 400) return;
    CHECK(depths.count(1) == 1);
    CHECK(depths.count(format::max_depth) == 1);
    CHECK(leaf_sizes.count(1) == 1);
    CHECK(leaf_sizes.count(format::plain_leaf::max_triangles) == 1);
    CHECK(*leaf_sizes.rbegin() > format::strip_leaf::max_balanced_entries - 2);
    std::uint32_t all = 0;
    for (const std::uint32_t each : features) all |= each;
    // Deformable blobs are made of edits: open_deformable_test.cpp.
    CHECK((all | format::feature::deformable) == format::feature::known);
}

#if ESPALIER_COUNT_STEPS
TEST_CASE("work: the counters of a closest hit are those of the counted query") {
    const TestBlob& test_blob = small_test_blobs().front();
    QueryMaker maker(test_blob.decoded, 3);
    for (int i = 0; i < 100; ++i) {
        const Ray ray = maker.any_ray();
        QueryCounters counters;
        detail::step_counter = {};
        static_cast<void>(raycast(test_blob.opened.blob, ray, counters));
        REQUIRE(detail::step_counter.nodes == counters.nodes);
        REQUIRE(detail::step_counter.leaves == counters.leaves);
    }
}
#endif

}  // namespace
}  // namespace espalier::tests::weird_blob_test
