#include "placement_check.hpp"

#include <runtime/lattice/to_local.hpp>
#include <runtime/pairs/queries.hpp>

#include "support/loops/pair_loop.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/test_pair_frame.hpp"

namespace espalier::tests {

namespace {

constexpr std::uint64_t no_limit = ~std::uint64_t{0};

/// What one instruction set finds, and how much work it was.
struct Touching {
    std::vector<detail::TrianglePair> pairs;
    std::uint64_t work = 0;
    bool operator==(const Touching&) const = default;
};

Touching find_touching(const InstructionPath& path, const detail::PairFrame& frame) {
    Touching result;
    std::uint64_t left = no_limit;
    const auto add = [&](const detail::TrianglePair& pair) {
        result.pairs.push_back(pair);
        return Visit::next;
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
            if (paths.empty() || path.search_pairs != paths.back().search_pairs) paths.push_back(path);
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
    const bool same = a.pair == b.pair && tests::same_bits(a.distance.squared, b.distance.squared);
    const auto same_weights = [](const detail::Weights& one, const detail::Weights& other) {
        return tests::same_bits(one.u, other.u) && tests::same_bits(one.v, other.v);
    };
    return same && same_weights(a.distance.on_a, b.distance.on_a) && same_weights(a.distance.on_b, b.distance.on_b);
}

detail::TrianglePair triangles_of(const detail::TrianglePair& references, const DecodedBlob& a, const DecodedBlob& b) {
    return {{a.owners[references.a.index]}, {b.owners[references.b.index]}};
}

/// The pairs of triangles that pairs of references stand for, each at the lowest of them.
std::vector<detail::TrianglePair> each_once(const std::vector<detail::TrianglePair>& references, const DecodedBlob& a,
                                            const DecodedBlob& b) {
    std::map<detail::TrianglePair, detail::TrianglePair> lowest;
    for (const detail::TrianglePair& each : references) {
        auto& least = lowest.try_emplace(triangles_of(each, a, b), each).first->second;
        least = std::min(least, each);
    }
    std::vector<detail::TrianglePair> pairs;
    for (const detail::TrianglePair& each : references)
        if (const auto pair = triangles_of(each, a, b); lowest.at(pair) == each) pairs.push_back(pair);
    return pairs;
}

std::vector<PairContact> contacts_of(const std::vector<detail::TrianglePair>& pairs) {
    std::vector<PairContact> contacts;
    for (const detail::TrianglePair& pair : pairs) contacts.push_back({pair.a, pair.b, QueryStatus::ok});
    return contacts;
}

/// All pages of some size, one after the other.
std::vector<PairContact> in_pages(const Blob& a, const PlacedBlob& b, std::size_t size) {
    std::vector<PairContact> all, page(size);
    Cursor from;
    for (;;) {
        const Filled filled = collect_contacts(a, b, page, WorkLimit::unlimited(), from);
        const auto written = filled.in(page);
        all.insert(all.end(), written.begin(), written.end());
        if (filled.status == QueryStatus::ok) return all;
        REQUIRE(filled.status == QueryStatus::output_full);
        REQUIRE(filled.count == size);
        from = filled.next;
    }
}

/// The public functions: all pairs in the order of the paths, into an array that is, by turns, too small, just right or
/// too large; and in pages.
void check_lists(const Blob& a, const PlacedBlob& b, const std::vector<detail::TrianglePair>& expected,
                 std::uint64_t turn) {
    const std::vector<PairContact> all = contacts_of(expected);
    std::vector<PairContact> pairs;
    const auto add = [&](const PairContact& pair) { pairs.push_back(pair); };
    REQUIRE(for_each_contact(a, b, add, WorkLimit::unlimited()) == QueryStatus::ok);
    REQUIRE(pairs == all);
    const std::size_t places = turn % 3 == 0 ? all.size() / 2 : all.size() + turn % 3 - 1;
    pairs.assign(places, PairContact{});
    const Filled filled = collect_contacts(a, b, pairs, WorkLimit::unlimited());
    REQUIRE(filled.status == (places < all.size() ? QueryStatus::output_full : QueryStatus::ok));
    REQUIRE(filled.count == std::min(places, all.size()));
    REQUIRE(std::equal(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(filled.count), all.begin()));
    // A page costs the way to it: large lists in few pages.
    REQUIRE(in_pages(a, b, 1 + turn % 5 + all.size() / 40) == all);
}

/// A point of a triangle of the grid in a's space: the runtime's own translation, since the walk is compared here.
Vec3 in_world(const detail::PairFrame& frame, const detail::LatticeTriangle& triangle, const detail::Weights& weights) {
    const Vec3 point = detail::point_of(triangle, weights.u, weights.v);
    const auto steps = [&](float along) { return std::ldexp(along, frame.shift); };
    return detail::to_local(*frame.a, steps(point.x), steps(point.y), steps(point.z));
}

/// At the least distance, and within some ulp around it, by turns: the paths and the public functions.
void check_distance(const Blob& a, const PlacedBlob& b, const detail::PairFrame& frame, const PairLoop& loop,
                    Paths paths, std::uint64_t turn) {
    const std::vector<detail::FoundTriangles> nearest_pairs = loop.nearest_pairs();
    REQUIRE_FALSE(nearest_pairs.empty());
    const detail::FoundTriangles& least = nearest_pairs.front();
    const int exponent = frame.a->step_exponent + frame.shift;
    const float expected_distance = std::ldexp(std::sqrt(least.distance.squared), exponent);
    const BlobDistance nearest = distance(a, b, WorkLimit::unlimited());
    REQUIRE(nearest);
    REQUIRE(detail::TrianglePair{nearest.a, nearest.b} == least.pair);
    REQUIRE(tests::same_bits(nearest.distance, expected_distance));
    bool found = false;
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
        REQUIRE(within_distance(a, b, in_units, WorkLimit::unlimited()) == YesNo::of(expected));
        const BlobDistance within = distance(a, b, WorkLimit::unlimited(), in_units);
        REQUIRE(within.status == (expected ? QueryStatus::ok : QueryStatus::not_found));
        REQUIRE(detail::TrianglePair{within.a, within.b} == (expected ? first->pair : detail::TrianglePair{}));
        // Of pairs that are equally near but for rounding, exact arithmetic may find another one within the radius.
        const float distance_of_first = expected ? std::ldexp(std::sqrt(first->distance.squared), exponent) : infinity;
        REQUIRE(tests::same_bits(within.distance, expected ? std::min(distance_of_first, in_units) : infinity));
    }
}

}  // namespace

void check_placement(const PairedBlob& a, const PairedBlob& b, const Transform& placement, const Questions& questions,
                     PlacementCounts& counts) {
    CAPTURE(a.test.name);
    CAPTURE(b.test.name);
    CAPTURE(describe(placement));
    const Blob& blob_a = a.test.opened.blob;
    const Blob& blob_b = b.test.opened.blob;
    TestPairFrame frame;
    const QueryStatus status = detail::place_pair(detail::data_of(blob_a), detail::data_of(blob_b), placement, frame);
    ++counts.asked;
    const PlacedBlob placed_b(blob_b, placement);
    const YesNo answer = overlaps(blob_a, placed_b, WorkLimit::unlimited());
    if (status != QueryStatus::ok) REQUIRE(answer.status() == status);
    else REQUIRE((answer.yes() || answer.no()));
    if (status != QueryStatus::ok) {
        ++counts.refused;
        return;
    }
    const PairLoop loop(frame, a.groups, b.groups);
    const std::vector<detail::TrianglePair> expected = loop.every_contact();

    const Paths paths = paths_for(questions.paths, counts.asked);
    const Touching first = find_touching(paths.front(), frame);
    for (std::size_t i = 1; i < paths.size(); ++i) {
        CAPTURE(std::string(paths[i].name));
        REQUIRE(find_touching(paths[i], frame) == first);
    }
    const std::vector<detail::TrianglePair> listed = each_once(first.pairs, a.test.decoded, b.test.decoded);
    std::vector<detail::TrianglePair> sorted = listed;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(sorted == expected);
    REQUIRE(answer.yes() == !expected.empty());
    check_lists(blob_a, placed_b, listed, counts.asked);
    counts.repeated += first.pairs.size() - listed.size();
    counts.touching += answer.yes() ? 1u : 0u;
    counts.pairs += expected.size();

    const PairContact contact = first_contact(blob_a, placed_b, WorkLimit::unlimited());
    REQUIRE(contact.status == answer.status());
    if (contact)
        REQUIRE(detail::TrianglePair{contact.a, contact.b} ==
                triangles_of(first.pairs.front(), a.test.decoded, b.test.decoded));
    else REQUIRE((contact.a == no_triangle && contact.b == no_triangle));
    if (!questions.distances) return;

    const BlobDistance nearest = distance(blob_a, placed_b, WorkLimit::unlimited());
    if (frame.gap > 1024.0f * frame.span) {
        REQUIRE(nearest.status == QueryStatus::out_of_range);
        ++counts.too_far;
        return;
    }
    REQUIRE(nearest);
    if (answer.no()) {
        check_distance(blob_a, placed_b, frame, loop, paths, counts.asked);
        ++counts.distances;
        return;
    }
    REQUIRE(nearest.distance == 0.0f);
    REQUIRE((nearest.a == contact.a && nearest.b == contact.b));
    REQUIRE(within_distance(blob_a, placed_b, 0.0f, WorkLimit::unlimited()).yes());
}

void tell_calls(const std::string& mesh, const PlacementCounts& random, const PlacementCounts& adversarial,
                bool with_distance) {
    const auto contacts = [](const PlacementCounts& counts) { return counts.asked - counts.refused; };
    const auto distances = [&](const PlacementCounts& counts) { return contacts(counts) - counts.too_far; };
    MESSAGE(
        calls_made("two blobs: overlaps, first contact, all contacts", mesh, contacts(random), contacts(adversarial)));
    if (with_distance)
        MESSAGE(calls_made("two blobs: distance, within distance", mesh, distances(random), distances(adversarial)));
    const auto tell = [](const std::string& kind, const PlacementCounts& counts) {
        if (counts.asked == 0) return;
        MESSAGE(kind, ": ", counts.touching, " touch, in ", counts.pairs, " pairs; ", counts.distances,
                " distances above 0; ", counts.refused, " out of range, ", counts.too_far, " too far for a distance");
    };
    tell("random", random);
    tell("adversarial", adversarial);
}

}  // namespace espalier::tests
