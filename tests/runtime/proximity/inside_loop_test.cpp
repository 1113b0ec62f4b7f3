// Inside and outside: winding numbers and signed distances equal the loop over all triangles.
#include "support/testing.hpp"

#include <runtime/answers/nearest_to_local.hpp>
#include <runtime/proximity/winding.hpp>

#include "support/loops/triangle_loop.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/winding_points.hpp"

namespace espalier::tests::inside_loop_test {
namespace {

using detail::AxisDirection;
using detail::RoundedPoint;
using detail::Winding;
using detail::WindingRay;

constexpr AxisDirection all_directions[] = {{0, false}, {0, true}, {1, false}, {1, true}, {2, false}, {2, true}};

/// A blob of any surface whose flag says that it is closed. `open` takes the flag's word, as it may: how often a
/// surface is crossed on one way out of it is well defined even where other ways cross it otherwise.
TestBlob said_to_be_closed(OpenedBlob opened, const std::string& name) {
    const auto flag = static_cast<std::byte>(format::feature::closed);  // of the lowest byte
    static_assert(format::feature::closed < 256);
    opened.bytes.at(format::header::features_at) |= flag;
    repair_checksum(opened.bytes);
    OpenedBlob again(std::move(opened.bytes));
    REQUIRE(again.blob.is_closed());
    DecodedBlob decoded = decode(again.bytes);
    return {name, std::move(again), std::move(decoded)};
}

/// By the shortest way out, which `contains` takes, and by one of all.
void check_winding(const TestBlob& blob, const TriangleLoop& loop, Vec3 point, bool is_closed, Random& random) {
    CAPTURE(describe(Sphere{point, 0.0f}));
    const YesNo answer = contains(blob.opened.blob, point);
    REQUIRE(!is_refused(answer.status()));
    const bool inside = answer.yes();
    std::optional<WindingRay> ray = shortest_way_out(blob.opened.blob, point);
    if (!ray) {
        REQUIRE_FALSE(inside);
        return;
    }
    const auto check_way = [&] {
        const Winding expected = loop.winding(*ray);
        const Winding winding = detail::winding_number(detail::data_of(blob.opened.blob), *ray);
        REQUIRE(winding.on_surface == expected.on_surface);
        if (!winding.on_surface) REQUIRE(winding.number == expected.number);
        return expected.is_inside();
    };
    REQUIRE(inside == check_way());
    ray->direction = all_directions[random.below(6)];
    const bool inside_that_way = check_way();
    if (is_closed) REQUIRE(inside == inside_that_way);
}

/// Says whether the point is inside.
bool check_signed_distance(const TestBlob& blob, const TriangleLoop& loop, Vec3 point, float max_distance) {
    CAPTURE(describe(Sphere{point, max_distance}));
    const Blob& opened = blob.opened.blob;
    const ClosestPoint nearest = signed_distance(opened, point, max_distance);
    RoundedPoint rounded;
    if (detail::round_point(detail::data_of(opened), point, infinity, rounded) != QueryStatus::ok) {
        REQUIRE(nearest.status == QueryStatus::out_of_range);
        return false;
    }
    const std::optional<WindingRay> ray = shortest_way_out(opened, point);
    const Winding winding = ray ? loop.winding(*ray) : Winding{};
    std::vector<detail::FoundNearest> found;
    if (detail::round_point(detail::data_of(opened), point, max_distance, rounded) == QueryStatus::ok)
        found = loop.by_distance(rounded, 1);
    ClosestPoint expected;
    if (found.empty()) {
        expected.status = QueryStatus::not_found;
        expected.distance = max_distance;
    } else {
        // The runtime's own translation: what is found, not the translation, is compared here.
        detail::set_unfinished(expected, found[0]);
        detail::finish(detail::data_of(opened), rounded, point, max_distance, expected);
    }
    if (winding.is_inside() && !winding.on_surface) expected.distance = -expected.distance;
    REQUIRE(same_bits(nearest, expected));
    return winding.is_inside();
}

/// As far as any, some way off, or nowhere.
float some_limit(const TestBlob& blob, Random& random) {
    if (random.coin()) return infinity;
    const Vec3 low = blob.opened.blob.bounds().min, high = blob.opened.blob.bounds().max;
    return random.below(8) == 0 ? 0.0f : (high.x - low.x + high.y - low.y) * 0.05f * random.unit();
}

struct Tally {
    std::uint64_t random = 0, awkward = 0, inside = 0;
};

void check_points(const TestBlob& blob, std::uint64_t seed, std::uint64_t count, unsigned awkward_of_ten,
                  bool is_closed, Tally& tally) {
    CAPTURE(blob.name);
    const TriangleLoop loop(blob.decoded);
    QueryMaker maker(blob.decoded, seed);
    Random random(seed);
    for (std::uint64_t i = 0; i < count; ++i) {
        const bool awkward = i % 10 < awkward_of_ten;
        // Every tenth awkward one is that of a sphere: near, far and very far away.
        const Vec3 point = !awkward                ? random_point(blob, random)
                           : random.below(10) == 0 ? maker.sphere().center
                                                   : awkward_point(blob, random);
        check_winding(blob, loop, point, is_closed, random);
        tally.inside += check_signed_distance(blob, loop, point, some_limit(blob, random)) ? 1u : 0u;
        ++(awkward ? tally.awkward : tally.random);
    }
}

void tell_calls(const std::string& mesh, const Tally& tally) {
    MESSAGE(calls_made("distance: contains, signed distance", mesh, tally.random, tally.awkward));
}

TEST_CASE("inside: winding numbers and signed distances equal the loop for every direction") {
    Tally tally;
    for (const TestBlob& blob : closed_blobs()) check_points(blob, 1100, scaled_share(2'000), 5, true, tally);
    tell_calls(generated_meshes, tally);
    CHECK(tally.inside > tally.random / 10);
}

TEST_CASE("inside: crossings of open surfaces equal the loop") {
    Tally tally;
    for (const TestBlob& blob : small_test_blobs()) {
        if (blob.opened.blob.is_closed()) continue;
        const TestBlob forged = said_to_be_closed(OpenedBlob(blob.opened.bytes), blob.name);
        check_points(forged, 1120, scaled_share(300), 5, false, tally);
    }
    CHECK(tally.inside > 0);
}

TEST_CASE("inside: winding numbers and signed distances equal the loop on real meshes") {
    for_each_real_mesh(
        [](const Mesh& mesh, Profile profile) {
            OpenedBlob opened(mesh, with_profile(profile));
            const bool is_closed = opened.blob.is_closed();
            const TestBlob blob = said_to_be_closed(std::move(opened), mesh.name);
            Tally tally;
            // Times a scale of 1,000 these are at least the counts that a release must show.
            check_points(blob, 1150 + static_cast<std::uint64_t>(profile), scaled_share(112), 1, is_closed, tally);
            tell_calls(mesh.name, tally);
        },
        quickly_baked);
}

}  // namespace
}  // namespace espalier::tests::inside_loop_test
