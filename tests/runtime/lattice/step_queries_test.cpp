// Claims about queries in lattice steps: the kernel is exact, every query equals the loop over all triangles, and what
// is out of range is refused.
#include "support/testing.hpp"

#include <climits>

#include <runtime/overlap/rounded_shapes.hpp>
#include <runtime/rays/whole_segment.hpp>
#include <runtime/traversal/find.hpp>

#include "oracle/convex_hull.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/steps_maker.hpp"

namespace espalier::tests::step_queries_test {
namespace {

using oracle::BigInteger;

LatticePoint steps(const GridPoint& p) { return {p[0], p[1], p[2]}; }

/// Towards a corner, a side or a place in the face more often than not, from near or from anywhere.
LatticeSegment some_segment(Random& random, unsigned bits, const GridTriangle& triangle) {
    const auto far = [&] { return random.between(-max_lattice_coordinate, max_lattice_coordinate); };
    const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
    GridPoint from = some_grid_point(random, bits), to = some_grid_point(random, bits);
    if (random.below(4) == 0) from = {far(), far(), far()};
    const GridPoint& p = corners[random.below(3)];
    const GridPoint& q = corners[random.below(3)];
    GridPoint target = p;
    if (random.coin())
        for (unsigned k = 0; k < 3; ++k) target[k] = (p[k] + q[k]) / 2 + random.between(-1, 1);
    const auto kind = random.below(4);
    if (kind == 0) to = target;
    else if (kind == 1 || kind == 2) {  // as far behind it as before it
        to = target;
        for (unsigned k = 0; k < 3; ++k)
            to[k] = std::clamp(2 * target[k] - from[k], -max_lattice_coordinate, max_lattice_coordinate);
    } else {
        if (random.coin()) {  // along an axis
            const std::uint32_t axis = random.below(3);
            to = from = target;
            from[axis] = far(), to[axis] = far();
        }
    }
    return random.coin() ? LatticeSegment{steps(from), steps(to)} : LatticeSegment{steps(to), steps(from)};
}

oracle::Point exact(const LatticePoint& p) { return oracle::Point(Rational(p.x), Rational(p.y), Rational(p.z)); }

/// Where the segment crosses the triangle, if it does.
std::optional<oracle::Crossing> crossing_in_truth(const LatticeSegment& segment, const GridTriangle& triangle) {
    if (segment.from == segment.to) return std::nullopt;
    const oracle::Point from = exact(segment.from), to = exact(segment.to);
    auto crossing = oracle::cross({from, to - from}, exact_triangle(triangle));
    if (!crossing || crossing->t.sign() < 0 || crossing->t > Rational(1)) return std::nullopt;
    return crossing;
}

Rational quotient(const detail::Crossing& crossing) {
    const auto whole = [](const detail::Int128& a) { return BigInteger::of_words(a.high, a.low); };
    return {whole(crossing.numerator), whole(crossing.denominator)};
}

struct Tally {
    std::uint64_t segments = 0, hits = 0, boxes = 0, overlapping = 0;
};

void check_segment(const TestBlob& test_blob, const TriangleLoop& loop, const LatticeSegment& segment, Tally& tally) {
    CAPTURE(describe(segment));
    const Blob& blob = test_blob.opened.blob;
    LatticeHit expected;
    detail::WholeSegment whole;
    if (whole.set(detail::data_of(blob), segment) == QueryStatus::ok) expected = loop.first_hit(whole);
    else expected.status = QueryStatus::invalid_argument;
    const LatticeHit hit = raycast(blob, segment);
    REQUIRE(hit.status == expected.status);
    REQUIRE(occluded(blob, segment).status() == expected.status);
    REQUIRE(hit.triangle == expected.triangle);
    REQUIRE(hit.t == expected.t);
    REQUIRE(hit.side == expected.side);
    ++tally.segments;
    tally.hits += hit ? 1u : 0u;
}

void check_box(const TestBlob& test_blob, const TriangleLoop& loop, const LatticeBox& box, Random& random,
               Tally& tally) {
    CAPTURE(describe(box));
    const Blob& blob = test_blob.opened.blob;
    detail::Rounded<Box> rounded;
    const QueryStatus status = detail::round_volume(detail::data_of(blob), box, rounded);
    REQUIRE(!is_refused(status));
    const auto expected = status == QueryStatus::not_found ? std::vector<std::uint32_t>() : loop.every_overlap(rounded);
    REQUIRE(overlaps(blob, box).yes() == !expected.empty());
    std::vector<std::uint32_t> found;
    REQUIRE(for_each_overlap(blob, box, [&](TriangleId t) { found.push_back(t.index); }) == QueryStatus::ok);
    if (blob.duplicate_reference_count() != 0) std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
    found.clear();
    std::vector<TriangleId> room(1 + random.below(50));
    Filled page;
    do {
        page = collect_overlaps(blob, box, room, page.next);
        for (const TriangleId triangle : page.in(room)) found.push_back(triangle.index);
    } while (page.status == QueryStatus::output_full);
    REQUIRE(page.status == QueryStatus::ok);
    if (blob.duplicate_reference_count() != 0) std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
    ++tally.boxes;
    tally.overlapping += expected.empty() ? 0u : 1u;
}

void check_blob(const TestBlob& blob, std::uint64_t count, std::uint64_t seed, Tally& tally) {
    CAPTURE(blob.name);
    const TriangleLoop loop(blob.decoded);
    StepsMaker maker(blob.decoded, seed);
    for (std::uint64_t i = 0; i < count; ++i) {
        check_segment(blob, loop, maker.segment(i % 2 == 1), tally);
        check_box(blob, loop, maker.box(i % 2 == 1), maker.random(), tally);
    }
}

void tell(const Tally& tally, const std::string& mesh) {
    MESSAGE(tally.segments, " segments, ", tally.hits, " of them hit; ", tally.boxes, " boxes, ", tally.overlapping,
            " of them overlap something");
    MESSAGE(calls_made("segments in steps", mesh, tally.segments / 2, tally.segments / 2));
    MESSAGE(calls_made("boxes in steps", mesh, tally.boxes / 2, tally.boxes / 2));
}

TEST_CASE("lattice query: crossings of a segment equal exact arithmetic in place and side") {
    Random random(1);
    std::uint64_t crossed = 0, touches = 0, ends = 0, narrow = 0;
    const std::uint64_t count = scaled(100'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 1 + random.below(24);
        const GridTriangle triangle = some_triangle(random, bits);
        const LatticeSegment segment = some_segment(random, bits, triangle);
        CAPTURE(describe(segment));
        const auto expected = crossing_in_truth(segment, triangle);
        detail::WholeSegment whole;
        detail::Crossing crossing;
        const bool crosses = whole.set(lattice_asset(bits), segment) == QueryStatus::ok &&
                             detail::crosses(whole, lattice_triangle(triangle), crossing);
        REQUIRE(crosses == expected.has_value());
        if (!crosses) continue;
        ++crossed;
        narrow += whole.is_narrow ? 1u : 0u;
        REQUIRE(crossing.front == expected->front);
        REQUIRE(quotient(crossing) == expected->t);
        const Rational t = Rational::of(std::int64_t{detail::fixed_point(crossing)}, -31);
        REQUIRE(t <= expected->t);
        REQUIRE(expected->t < t + Rational::of(1, -31));
        if (expected->u.sign() == 0 || expected->v.sign() == 0 || expected->u + expected->v == Rational(1)) ++touches;
        if (expected->t.sign() == 0 || expected->t == Rational(1)) ++ends;
    }
    CHECK(crossed > count / 10);
    CHECK(touches > count / 50);
    CHECK(ends > count / 50);
    CHECK(narrow > crossed / 4);
    CHECK(narrow < crossed);
    MESSAGE(decisions_made("segment in steps and triangle", count));
}

TEST_CASE("lattice query: the first of two hits is decided exactly") {
    Random random(2);
    std::uint64_t alike = 0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const auto some = [&] {
            detail::Crossing crossing;
            const auto bits = static_cast<int>(1 + random.below(82));
            const detail::Int128 wide(static_cast<std::int64_t>(random.next() >> 1), random.next());
            crossing.denominator = wide >> (127 - bits);
            crossing.denominator = crossing.denominator + detail::Int128(1);
            crossing.numerator = crossing.denominator >> static_cast<int>(random.below(4));
            return crossing;
        };
        const detail::Crossing a = some();
        detail::Crossing b = some();
        if (random.coin()) {  // as near as can be
            b = a;
            if (random.coin()) b.denominator = b.denominator + detail::Int128(1);
        }
        REQUIRE(detail::is_before(a, b) == (quotient(a) < quotient(b)));
        alike += quotient(a) == quotient(b) ? 1u : 0u;
    }
    CHECK(alike > 0);
}

TEST_CASE("lattice query: segments and boxes equal the loop") {
    Tally tally;
    for (const TestBlob& blob : small_test_blobs()) check_blob(blob, scaled_share(600), 3, tally);
    for (const TestBlob& blob : medium_test_blobs()) check_blob(blob, scaled_share(100), 4, tally);
    CHECK(tally.hits > tally.segments / 10);
    CHECK(tally.overlapping > tally.boxes / 10);
    tell(tally, generated_meshes);
}

TEST_CASE("lattice query: segments and boxes equal the loop on real meshes") {
    for_each_real_mesh([](const Mesh& mesh, Profile profile) {
        OpenedBlob opened(mesh, with_profile(profile));
        DecodedBlob decoded = decode(opened.bytes);
        const std::uint64_t count = scaled_share(decoded.triangles.size() > 200'000 ? 3 : 112);
        const TestBlob blob = {mesh.name, std::move(opened), std::move(decoded)};
        Tally tally;
        check_blob(blob, count, 5, tally);
        tell(tally, mesh.name);
    });
}

TEST_CASE("lattice query: a box overlaps the triangles that exact arithmetic gives") {
    std::uint64_t met = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        if (blob.decoded.bits > 8) continue;
        CAPTURE(blob.name);
        StepsMaker maker(blob.decoded, 6);
        for (std::uint64_t i = 0; i < scaled_share(30); ++i) {
            const LatticeBox box = maker.box(true);
            CAPTURE(describe(box));
            std::vector<std::uint32_t> expected, found;
            const auto inside = [](std::int32_t a) { return std::int64_t{std::clamp(a, -1000, 1000)}; };
            const std::int64_t low[3] = {inside(box.min.x), inside(box.min.y), inside(box.min.z)};
            const std::int64_t high[3] = {inside(box.max.x), inside(box.max.y), inside(box.max.z)};
            const bool is_empty = box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z;
            for (std::uint32_t t = 0; t < blob.decoded.triangles.size() && !is_empty; ++t) {
                if (blob.decoded.owners[t] != t) continue;
                std::vector<oracle::WholePoint<std::int64_t>> box_corners, corners;
                for (int signs = 0; signs < 8; ++signs) {
                    const oracle::WholePoint<std::int64_t> corner = {(signs & 1) != 0 ? high[0] : low[0],
                                                                     (signs & 2) != 0 ? high[1] : low[1],
                                                                     (signs & 4) != 0 ? high[2] : low[2]};
                    if (std::find(box_corners.begin(), box_corners.end(), corner) == box_corners.end())
                        box_corners.push_back(corner);
                }
                const GridTriangle& triangle = blob.decoded.triangles[t];
                for (const GridPoint& p : {triangle.a, triangle.b, triangle.c}) corners.push_back({p[0], p[1], p[2]});
                if (oracle::hulls_meet(box_corners, corners)) expected.push_back(t);
            }
            REQUIRE(for_each_overlap(blob.opened.blob, box, [&](TriangleId t) { found.push_back(t.index); }) ==
                    QueryStatus::ok);
            REQUIRE(found == expected);
            met += expected.size();
        }
    }
    CHECK(met > 0);
}

TEST_CASE("lattice query: the lowest storage index wins at one place also with copies") {
    OpenedBlob opened(make_soup(300, 1), with_copies());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    DecodedBlob decoded = decode(opened.bytes);
    const TestBlob blob = {"with copies", std::move(opened), std::move(decoded)};
    const TriangleLoop loop(blob.decoded);
    StepsMaker maker(blob.decoded, 7);
    Tally tally;
    for (std::uint64_t i = 0; i < scaled(1'000); ++i) check_segment(blob, loop, maker.segment(i % 4 != 0), tally);
    CHECK(tally.hits > tally.segments / 10);
}

TEST_CASE("lattice query: an end beyond the range is refused and an end at it is answered") {
    for_each_profile([](Profile profile) {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f), with_profile(profile));
        const Lattice lattice = cube.blob.lattice();
        const std::int32_t middle = lattice.extent[0] / 2 + 1;
        constexpr std::int32_t most = max_lattice_coordinate;
        LatticeHit hit = raycast(cube.blob, LatticeSegment{{middle, middle - 2, -most}, {middle, middle - 2, most}});
        CHECK(hit.triangle != no_triangle);
        CHECK(hit.side == Side::front);
        CHECK(hit.t == 1u << 30);
        hit = raycast(cube.blob, LatticeSegment{{middle, middle - 2, middle}, {middle, middle - 2, most}});
        CHECK(hit.side == Side::back);
        const OpenedBlob empty(Mesh{});
        for (const std::int32_t beyond : {most + 1, -most - 1, INT32_MAX, INT32_MIN}) {
            for (int place = 0; place < 6; ++place) {
                std::int32_t c[6] = {};
                c[place] = beyond;
                const LatticeSegment segment = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
                for (const Blob& blob : {cube.blob, empty.blob}) {
                    hit = raycast(blob, segment);
                    CHECK(hit.status == QueryStatus::out_of_range);
                    CHECK(hit.triangle == no_triangle);
                    CHECK(hit.t == 0xFFFFFFFFu);
                    CHECK(occluded(blob, segment).status() == QueryStatus::out_of_range);
                }
                CHECK(raycast(Blob(), segment).status == QueryStatus::not_open);
                CHECK(occluded(Blob(), segment).status() == QueryStatus::not_open);
            }
        }
    });
}

TEST_CASE("lattice query: places in a leaf have no more bits than its grid") {
    for (const TestBlob& test_blob : small_test_blobs()) {
        const detail::BlobData& blob = detail::data_of(test_blob.opened.blob);
        detail::scalar::with_leaves_of(blob, [&]<class Leaf>() {
            for (std::uint32_t index = 0; index < blob.node_count; ++index) {
                const auto node = detail::node_at<typename Leaf::Node>(blob, index);
                for (unsigned number = 0; number < node.leaf_children(); ++number) {
                    detail::scalar::with_leaf<Leaf>(blob, node, number, [&](const Leaf& leaf) {
                        // Places in a plain leaf have a sign.
                        const int least = Leaf::counts_from_zero ? -(1 << (leaf.grid_bits() - 1)) : 0;
                        const int end = least + (1 << leaf.grid_bits());
                        for (int k = 0; k < 3; ++k) {
                            for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
                                const int place = leaf.anchor(k) + leaf.offset(k, vertex) - leaf.grid_base(k);
                                REQUIRE((least <= place && place < end));
                            }
                        }
                    });
                }
            }
        });
    }
}

TEST_CASE("lattice query: coplanar segments and empty blobs have no hit and a segment without length is refused") {
    const OpenedBlob plane(make_plane_grid(4));
    const Lattice lattice = plane.blob.lattice();
    const LatticePoint corner = {}, opposite = {lattice.extent[0], lattice.extent[1], lattice.extent[2]};
    const OpenedBlob empty(Mesh{});
    for (const Blob& blob : {plane.blob, empty.blob}) {
        CHECK(occluded(blob, LatticeSegment{corner, corner}).status() == QueryStatus::invalid_argument);
        CHECK(raycast(blob, LatticeSegment{corner, corner}).status == QueryStatus::invalid_argument);
    }
    CHECK(occluded(plane.blob, LatticeSegment{corner, opposite}).no());
    CHECK(overlaps(plane.blob, LatticeBox{corner, corner}).yes());
    CHECK(overlaps(plane.blob, LatticeBox{opposite, {-1, -1, -1}}).no());
    const LatticeHit hit = raycast(empty.blob, LatticeSegment{corner, {1, 1, 1}});
    CHECK(hit.status == QueryStatus::not_found);
    CHECK(hit.triangle == no_triangle);
    CHECK(raycast(Blob(), LatticeSegment{corner, {1, 1, 1}}).status == QueryStatus::not_open);
    CHECK(overlaps(Blob(), LatticeBox{{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX, INT32_MAX}}).status() ==
          QueryStatus::not_open);
    TriangleId room[1];
    CHECK(collect_overlaps(Blob(), LatticeBox{corner, corner}, room).status == QueryStatus::not_open);
    CHECK(Blob().lattice().extent[1] == 0);
}

}  // namespace
}  // namespace espalier::tests::step_queries_test
