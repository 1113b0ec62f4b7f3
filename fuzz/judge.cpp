#include "judge.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>

#include "support/answers/differences.hpp"
#include "support/answers/loop_answers.hpp"
#include "support/answers/path_answers.hpp"
#include "support/blobs/soundness.hpp"
#include "support/exercise/exercise.hpp"
#include "support/queries/ray_maker.hpp"

namespace espalier::fuzz {

namespace {

using namespace tests;

/// Nothing of a blob with copies that are of other triangles than they say: nobody checks that.
std::optional<DecodedBlob> decode_opened(std::span<const std::byte> bytes, const Blob& blob) {
    try {
        return decode(bytes);
    } catch (const std::exception& error) {
        if (blob.duplicate_reference_count() == 0) fail("decoder", error.what());
        return std::nullopt;
    }
}

}  // namespace

void fail(const char* what, const std::string& detail) {
    std::fprintf(stderr, "%s: %s\n", what, detail.c_str());
    std::abort();
}

void judge(std::span<const std::byte> bytes, const Blob& blob, Random& random, Maker maker) {
    const std::optional<DecodedBlob> decoded = decode_opened(bytes, blob);
    const bool has_copies = blob.duplicate_reference_count() != 0;  // then boxes hold parts of triangles
    const bool sound = decoded && ((maker == Maker::baker && has_copies) || is_sound(*decoded));
    if (maker == Maker::baker && !sound) fail("baker", "a blob that is not sound");
    try {
        exercise(blob, random, 2, sound);
    } catch (const std::exception& error) {
        fail("exercise", error.what());
    }
    if (const auto difference = path_difference(blob, random, sound))
        fail("path", *difference + (sound ? ", of a sound blob" : ", of a blob that is not sound"));
    if (!sound || decoded->triangles.empty()) return;
    const TriangleLoop loop(*decoded);
    QueryMaker queries(*decoded, random.next());
    std::uint64_t hits = 0;
    for (int i = 0; i < 3; ++i) {
        Ray ray = queries.any_ray();
        if (queries.random().coin()) queries.restrict(ray);
        if (const auto difference = ray_difference(blob, loop, ray, hits)) fail("ray", *difference);
        if (const auto difference = sphere_difference(blob, loop, queries.sphere(), hits)) fail("sphere", *difference);
    }
    ShapeMaker shapes(*decoded, random.next());
    SweepMaker sweeps(*decoded, random.next());
    if (const auto difference = loop_difference(blob, loop, shapes, sweeps)) fail("loop", *difference);
}

}  // namespace espalier::fuzz
