#include "placement_check.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <espalier/collide.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/pair_queries.hpp>

#include "support/base/calls.hpp"
#include "support/base/same_bits.hpp"
#include "support/loops/pair_loop.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/test_pair_frame.hpp"

namespace espalier::tests {

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

using Paths = std::span<const InstructionPath>;

Paths paths_for(AskedPaths asked, std::uint64_t turn) {
    const Paths all = different_paths();
    return asked == AskedPaths::all ? all : all.subspan(turn % all.size(), 1);
}

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
    float point[3];
    detail::point_of(triangle, weights[0], weights[1], point);
    const auto steps = [&](int axis) { return std::ldexp(point[axis], frame.shift); };
    return detail::to_world(*frame.a, steps(0), steps(1), steps(2));
}

/// At the least distance, and within some ulp around it, by turns: the paths and the public functions.
void check_distance(const Blob& a, const Blob& b, const Placement& placement, const detail::PairFrame& frame,
                    const PairLoop& loop, Paths paths, std::uint64_t turn) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<detail::FoundTriangles> nearest_pairs = loop.nearest_pairs();
    REQUIRE_FALSE(nearest_pairs.empty());
    const detail::FoundTriangles& least = nearest_pairs.front();
    const int exponent = frame.a->step_exponent + frame.shift;
    const float distance = std::ldexp(std::sqrt(least.distance.squared), exponent);
    PairDistance nearest;
    bool found = false;
    REQUIRE(minimum_distance(a, b, placement, infinity, nearest, found) == QueryStatus::ok);
    REQUIRE(found);
    REQUIRE(nearest.pair == least.pair);
    REQUIRE(tests::same_bits(nearest.distance, distance));
    REQUIRE(tests::same_bits(nearest.on_a, in_world(frame, least.a, least.distance.on_a)));
    REQUIRE(tests::same_bits(nearest.on_b, in_world(frame, least.b, least.distance.on_b)));
    for (const InstructionPath& path : paths) {
        CAPTURE(std::string(path.name));
        detail::FoundTriangles best;
        std::uint64_t left = no_limit;
        REQUIRE(path.nearest_pair(frame, infinity, false, best, found, left) == QueryStatus::ok);
        REQUIRE(same_bits(best, least));
    }
    float radius = std::sqrt(least.distance.squared);
    for (int step = 0; step < 3; ++step) radius = std::nextafter(radius, 0.0f);
    for (int step = 0; step < 7; ++step, radius = std::nextafter(radius, infinity)) {
        if (step % 4 != static_cast<int>(turn % 4)) continue;
        CAPTURE(radius);
        const detail::FoundTriangles* const first = first_within(nearest_pairs, radius);
        const bool expected = first != nullptr;
        for (const InstructionPath& path : paths) {
            CAPTURE(std::string(path.name));
            detail::FoundTriangles best;
            std::uint64_t left = no_limit;
            REQUIRE(path.nearest_pair(frame, radius, true, best, found, left) == QueryStatus::ok);
            REQUIRE(found == expected);
            REQUIRE(path.nearest_pair(frame, radius, false, best, found, left) == QueryStatus::ok);
            REQUIRE(found == expected);
            if (found) REQUIRE(same_bits(best, *first));
        }
        const float in_units = std::ldexp(radius, exponent);
        if (std::ldexp(in_units, -exponent) != radius) continue;  // no distance of the caller's is that one
        REQUIRE(within_distance(a, b, placement, in_units, found) == QueryStatus::ok);
        REQUIRE(found == expected);
        REQUIRE(minimum_distance(a, b, placement, in_units, nearest, found) == QueryStatus::ok);
        REQUIRE(found == expected);
        if (!found) continue;
        REQUIRE(nearest.pair == first->pair);
        REQUIRE(tests::same_bits(nearest.distance, std::min(distance, in_units)));
    }
}

}  // namespace

void check_placement(const PairedBlob& a, const PairedBlob& b, const Placement& placement, const Questions& questions,
                     PlacementCounts& counts) {
    CAPTURE(a.test.name);
    CAPTURE(b.test.name);
    CAPTURE(describe(placement));
    const Blob& blob_a = a.test.opened.blob;
    const Blob& blob_b = b.test.opened.blob;
    TestPairFrame frame;
    const QueryStatus status = detail::place_pair(blob_a.data(), blob_b.data(), placement, frame);
    bool answer = false;
    ++counts.asked;
    REQUIRE(collides(blob_a, blob_b, placement, answer) == status);
    if (status != QueryStatus::ok) {
        ++counts.refused;
        return;
    }
    const PairLoop loop(frame, a.groups, b.groups);
    const std::vector<TrianglePair> expected = loop.every_contact();

    const Paths paths = paths_for(questions.paths, counts.asked);
    const Touching first = find_touching(paths.front(), frame);
    for (std::size_t i = 1; i < paths.size(); ++i) {
        CAPTURE(std::string(paths[i].name));
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
    if (!questions.distances) return;

    const bool is_too_far = frame.gap > 1024.0f * frame.span;
    PairDistance nearest;
    REQUIRE(minimum_distance(blob_a, blob_b, placement, std::numeric_limits<float>::infinity(), nearest, found) ==
            (is_too_far ? QueryStatus::out_of_range : QueryStatus::ok));
    if (is_too_far) {
        ++counts.too_far;
        return;
    }
    if (!answer) {
        check_distance(blob_a, blob_b, placement, frame, loop, paths, counts.asked);
        ++counts.distances;
        return;
    }
    REQUIRE(found);
    REQUIRE(nearest.distance == 0.0f);
    REQUIRE(nearest.pair == contact);
    REQUIRE(within_distance(blob_a, blob_b, placement, 0.0f, found) == QueryStatus::ok);
    REQUIRE(found);
}

void tell_calls(const std::string& mesh, const PlacementCounts& random, const PlacementCounts& adversarial,
                bool with_distance) {
    const auto contacts = [](const PlacementCounts& counts) { return counts.asked - counts.refused; };
    const auto distances = [&](const PlacementCounts& counts) { return contacts(counts) - counts.too_far; };
    MESSAGE(
        calls_made("two blobs: collides, first contact, all contacts", mesh, contacts(random), contacts(adversarial)));
    if (with_distance)
        MESSAGE(calls_made("two blobs: minimum distance, within distance", mesh, distances(random),
                           distances(adversarial)));
    const auto tell = [](const std::string& kind, const PlacementCounts& counts) {
        if (counts.asked == 0) return;
        MESSAGE(kind, ": ", counts.touching, " touch, in ", counts.pairs, " pairs; ", counts.distances,
                " distances above 0; ", counts.refused, " out of range, ", counts.too_far, " too far for a distance");
    };
    tell("random", random);
    tell("adversarial", adversarial);
}

}  // namespace espalier::tests
