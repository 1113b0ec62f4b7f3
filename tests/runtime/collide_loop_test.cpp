// Two blobs: walking both trees changes nothing, on any instruction set.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <espalier/collide.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/pair_queries.hpp>

#include "../support/calls.hpp"
#include "../support/instruction_paths.hpp"
#include "../support/mesh_files.hpp"
#include "../support/pair_loop.hpp"
#include "../support/placement_maker.hpp"
#include "../support/profiles.hpp"
#include "../support/same_bits.hpp"
#include "../support/test_blobs.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::uint64_t no_limit = ~std::uint64_t{0};

/// What one instruction set finds, and how much work it was.
struct Touching {
    std::vector<TrianglePair> pairs;
    std::uint64_t work = 0;
    bool operator==(const Touching&) const = default;
};

Touching find_touching(const InstructionPath& path, const detail::PairFrame& frame) {
    Touching result;
    std::uint64_t left = no_limit;
    const auto add = [&](const TrianglePair& pair) {
        result.pairs.push_back(pair);
        return keep_going;
    };
    REQUIRE(path.touching_pairs(frame, add, left) == QueryStatus::ok);
    result.work = no_limit - left;
    return result;
}

/// Of those that walk two trees alike only the first.
const std::vector<InstructionPath>& different_paths() {
    static const std::vector<InstructionPath> different = [] {
        std::vector<InstructionPath> paths;
        for (const InstructionPath& path : instruction_paths())
            if (paths.empty() || path.touching_pairs != paths.back().touching_pairs) paths.push_back(path);
        return paths;
    }();
    return different;
}

struct Counts {
    std::uint64_t asked = 0;
    std::uint64_t touching = 0;
    std::uint64_t pairs = 0;
    std::uint64_t refused = 0;
    std::uint64_t distances = 0;  ///< above 0
};

bool same_bits(const detail::FoundTriangles& a, const detail::FoundTriangles& b) {
    bool same = a.pair == b.pair && tests::same_bits(a.distance.squared, b.distance.squared);
    for (int k = 0; k < 2; ++k)
        same = same && tests::same_bits(a.distance.on_a[k], b.distance.on_a[k]) &&
               tests::same_bits(a.distance.on_b[k], b.distance.on_b[k]);
    return same;
}

/// The public functions: all pairs in the order of the paths, into an array that is, by turns, too small, just right or
/// too large.
void check_lists(const Blob& a, const Blob& b, const Placement& placement, const std::vector<TrianglePair>& expected,
                 std::uint64_t turn) {
    std::vector<TrianglePair> pairs;
    const auto add = [&](const TrianglePair& pair) { return pairs.push_back(pair), keep_going; };
    REQUIRE(for_each_contact(a, b, placement, add) == QueryStatus::ok);
    REQUIRE(pairs == expected);
    const std::size_t places = turn % 3 == 0 ? expected.size() / 2 : expected.size() + turn % 3 - 1;
    pairs.assign(places, TrianglePair{});
    std::size_t count = 0;
    const QueryStatus status = all_contacts(a, b, placement, pairs, count);
    REQUIRE(status == (places < expected.size() ? QueryStatus::output_full : QueryStatus::ok));
    REQUIRE(count == std::min(places, expected.size()));
    REQUIRE(std::equal(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count), expected.begin()));
}

/// A point of a triangle of the grid in a's space: the runtime's own translation, since the walk is compared here.
Vec3 in_world(const detail::PairFrame& frame, const detail::LatticeTriangle& triangle, const float* weights) {
    const auto steps = [&](int axis) { return std::ldexp(detail::point_on(triangle, weights, axis), frame.shift); };
    return detail::to_world(*frame.a, steps(0), steps(1), steps(2));
}

/// At the least distance, and within some ulp around it, by turns: every path and the public functions.
void check_distance(const Blob& a, const Blob& b, const Placement& placement, const detail::PairFrame& frame,
                    const PairLoop& loop, std::uint64_t turn) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto least = loop.nearest_pair(infinity);
    REQUIRE(least.has_value());
    const int exponent = frame.a->step_exponent + frame.shift;
    const float distance = std::ldexp(std::sqrt(least->distance.squared), exponent);
    PairDistance nearest;
    bool found = false;
    REQUIRE(minimum_distance(a, b, placement, infinity, nearest, found) == QueryStatus::ok);
    REQUIRE(found);
    REQUIRE(nearest.pair == least->pair);
    REQUIRE(tests::same_bits(nearest.distance, distance));
    REQUIRE(tests::same_bits(nearest.on_a, in_world(frame, least->a, least->distance.on_a)));
    REQUIRE(tests::same_bits(nearest.on_b, in_world(frame, least->b, least->distance.on_b)));
    for (const InstructionPath& path : different_paths()) {
        CAPTURE(path.name);
        detail::FoundTriangles best;
        std::uint64_t left = no_limit;
        REQUIRE(path.nearest_pair(frame, infinity, false, best, found, left) == QueryStatus::ok);
        REQUIRE(same_bits(best, *least));
    }
    float radius = std::sqrt(least->distance.squared);
    for (int step = 0; step < 3; ++step) radius = std::nextafter(radius, 0.0f);
    for (int step = 0; step < 7; ++step, radius = std::nextafter(radius, infinity)) {
        if ((step + static_cast<int>(turn % 2)) % 2 != 0) continue;
        CAPTURE(radius);
        const bool expected = loop.is_any_within(radius);
        for (const InstructionPath& path : different_paths()) {
            CAPTURE(path.name);
            detail::FoundTriangles best;
            std::uint64_t left = no_limit;
            REQUIRE(path.nearest_pair(frame, radius, true, best, found, left) == QueryStatus::ok);
            REQUIRE(found == expected);
        }
        const float in_units = std::ldexp(radius, exponent);
        if (std::ldexp(in_units, -exponent) != radius) continue;  // no distance of the caller's is that one
        REQUIRE(within_distance(a, b, placement, in_units, found) == QueryStatus::ok);
        REQUIRE(found == expected);
        REQUIRE(minimum_distance(a, b, placement, in_units, nearest, found) == QueryStatus::ok);
        REQUIRE(found == expected);
        if (found) REQUIRE(tests::same_bits(nearest.distance, std::min(distance, in_units)));
    }
}

/// Every question about one placement, against the loop.
void check_placement(const TestBlob& a, const TestBlob& b, const Placement& placement, bool with_distance,
                     Counts& counts) {
    CAPTURE(a.name);
    CAPTURE(b.name);
    CAPTURE(describe(placement));
    const Blob& blob_a = a.opened.blob;
    const Blob& blob_b = b.opened.blob;
    detail::PairFrame frame;
    const QueryStatus status = detail::place_pair(blob_a.data(), blob_b.data(), placement, frame);
    bool answer = false;
    ++counts.asked;
    REQUIRE(collides(blob_a, blob_b, placement, answer) == status);
    if (status != QueryStatus::ok) {
        ++counts.refused;
        return;
    }
    const PairLoop loop(frame, a.decoded, b.decoded);
    const std::vector<TrianglePair> expected = loop.every_contact();

    const std::vector<InstructionPath>& paths = different_paths();
    const Touching first = find_touching(paths.front(), frame);
    for (std::size_t i = 1; i < paths.size(); ++i) {
        CAPTURE(paths[i].name);
        REQUIRE(find_touching(paths[i], frame) == first);
    }
    std::vector<TrianglePair> sorted = first.pairs;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(sorted == expected);
    REQUIRE(answer == !expected.empty());
    check_lists(blob_a, blob_b, placement, first.pairs, counts.asked);
    counts.touching += answer ? 1u : 0u;
    counts.pairs += expected.size();

    TrianglePair contact;
    bool found = false;
    REQUIRE(first_contact(blob_a, blob_b, placement, contact, found) == QueryStatus::ok);
    REQUIRE(found == answer);
    if (found) REQUIRE(contact == first.pairs.front());
    if (!with_distance) return;

    const bool is_too_far = frame.gap > 1024.0f * frame.span;
    PairDistance nearest;
    REQUIRE(minimum_distance(blob_a, blob_b, placement, std::numeric_limits<float>::infinity(), nearest, found) ==
            (is_too_far ? QueryStatus::out_of_range : QueryStatus::ok));
    if (is_too_far) return;
    if (!answer) {
        check_distance(blob_a, blob_b, placement, frame, loop, counts.asked);
        ++counts.distances;
        return;
    }
    REQUIRE(found);
    REQUIRE(nearest.distance == 0.0f);
    REQUIRE(nearest.pair == contact);
    REQUIRE(within_distance(blob_a, blob_b, placement, 0.0f, found) == QueryStatus::ok);
    REQUIRE(found);
}

enum class Kind { random, apart, adversarial };

void tell_calls(const std::string& mesh, std::uint64_t random, std::uint64_t adversarial, bool with_distance) {
    MESSAGE(calls_made("two blobs: collides, first contact, all contacts", mesh, random, adversarial));
    if (with_distance) MESSAGE(calls_made("two blobs: minimum distance, within distance", mesh, random, adversarial));
}

Placement make(PlacementMaker& maker, Kind kind) {
    return kind == Kind::random ? maker.random() : kind == Kind::apart ? maker.apart() : maker.adversarial();
}

void check_blobs(const std::vector<TestBlob>& blobs, std::uint64_t count, Kind kind, bool with_distance) {
    Counts counts;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        // Each with another mesh, and with itself.
        for (const std::size_t j : {(i + 4) % blobs.size(), i}) {
            PlacementMaker maker(blobs[i].decoded, blobs[j].decoded, 900 + i);
            for (std::uint64_t n = 0; n < count; ++n)
                check_placement(blobs[i], blobs[j], make(maker, kind), with_distance, counts);
        }
    }
    const std::uint64_t adversarial = kind == Kind::adversarial ? counts.asked : 0;
    tell_calls(generated_meshes, counts.asked - adversarial, adversarial, with_distance);
    MESSAGE(counts.touching, " touch, in ", counts.pairs, " pairs; ", counts.distances, " distances above 0; ",
            counts.refused, " out of range");
    if (!asks_enough()) return;
    CHECK(counts.touching > counts.asked / 20);
    CHECK(counts.touching < counts.asked);
    CHECK(counts.refused < counts.asked / 10);
}

/// Each profile against the next.
void check_real_mesh(const std::filesystem::path& file) {
    const Mesh mesh = read_mesh(file);
    if (mesh.triangles.size() > 200'000) return;  // baking it takes longer than asking it
    CAPTURE(mesh.name);
    std::vector<TestBlob> blobs;
    for (const format::Profile profile : every_profile) {
        OpenedBlob opened(mesh, with_profile(profile));
        DecodedBlob decoded = decode(opened.bytes);
        blobs.push_back({mesh.name + ", profile " + name_of(profile), std::move(opened), std::move(decoded)});
    }
    // Loops over pairs take their time: meshes are asked alike long, not alike often.
    const std::uint64_t count = scaled_share(std::max<std::uint64_t>(3, 120'000 / mesh.triangles.size()));
    Counts random, adversarial;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        const TestBlob& a = blobs[i];
        const TestBlob& b = blobs[(i + 1) % blobs.size()];
        PlacementMaker maker(a.decoded, b.decoded, 960 + i);
        for (std::uint64_t n = 0; n < count; ++n) {
            check_placement(a, b, make(maker, n % 2 == 0 ? Kind::random : Kind::apart), true, random);
            check_placement(a, b, maker.adversarial(), true, adversarial);
        }
    }
    tell_calls(mesh.name, random.asked, adversarial.asked, true);
    MESSAGE(random.touching, " and ", adversarial.touching, " touch, in ", random.pairs, " and ", adversarial.pairs,
            " pairs; ", random.distances, " and ", adversarial.distances, " distances above 0; ", adversarial.refused,
            " out of range");
}

}  // namespace

TEST_SUITE("two blobs against the loop") {
    TEST_CASE("placed anyhow: all pairs, in the same order on every path, and the first of them") {
        check_blobs(small_test_blobs(), scaled_share(30), Kind::random, false);
    }
    TEST_CASE("placed to touch, in one plane, far away or out of proportion: all pairs, on every path") {
        check_blobs(small_test_blobs(), scaled_share(30), Kind::adversarial, false);
    }
    TEST_CASE("placed side by side: the smallest distance and what is within a distance, on every path") {
        check_blobs(small_test_blobs(), scaled_share(6), Kind::apart, true);
    }
    TEST_CASE("placed to touch or nearly: the smallest distance and what is within a distance, on every path") {
        check_blobs(small_test_blobs(), scaled_share(6), Kind::adversarial, true);
    }

    TEST_CASE("real meshes: two blobs touch where the loop says, and are as far apart") {
        const auto files = mesh_files();
        if (files.empty()) {
            MESSAGE("SKIPPED: no .obj or .ply file in the folder ESPALIER_MESHES");
            return;
        }
        for (const auto& file : files) check_real_mesh(file);
    }
}
