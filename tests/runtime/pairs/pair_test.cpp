// Claims about two blobs as the header words them; loop_test.cpp compares them with the loop.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/pair.hpp>

#include "support/base/profiles.hpp"
#include "support/blobs/baking.hpp"
#include "support/format/decoder.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/test_pair_frame.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// A triangle mesh of its own is a mesh of one triangle.
Mesh one_triangle(Vec3 a, Vec3 b, Vec3 c) {
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {a, b, c};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

constexpr WorkLimit unlimited = WorkLimit::unlimited();

bool touch(const Blob& a, const Blob& b, const Transform& placement) {
    const YesNo answer = overlaps(a, {b, placement}, unlimited);
    REQUIRE((answer.yes() || answer.no()));
    return answer.yes();
}

using Contacts = std::vector<PairContact>;

Contacts all_contacts(const PlacedBlob& a, const PlacedBlob& b) {
    Contacts all;
    REQUIRE(for_each_contact(
                a, b, [&](const PairContact& pair) { all.push_back(pair); }, unlimited) == QueryStatus::ok);
    return all;
}

}  // namespace

TEST_SUITE("pair") {
    TEST_CASE("pair: the first in storage of two equally near leaves is met first") {
        Mesh pair = one_triangle({16, -16, -1}, {24, -16, 1}, {16, -24, 1});
        pair.positions.insert(pair.positions.end(), {{-16, 16, -1}, {-16, 24, 1}, {-24, 16, 1}});
        pair.triangles.push_back({3, 4, 5});
        const BakeOptions options = {
            .resolution = Resolution::bits(12), .profile = Profile::fast, .build = {.max_leaf_triangles = 1}};
        const OpenedBlob a(pair, options);
        const OpenedBlob b(one_triangle({-100, -100, 0}, {100, -100, 0}, {-100, 100, 0}), options);
        const PairContact expected = {{0}, {0}, QueryStatus::ok};
        CHECK(first_contact(a.blob, b.blob, unlimited) == expected);
        CHECK(all_contacts(a.blob, b.blob) == Contacts{expected, {{1}, {0}, QueryStatus::ok}});
    }

    TEST_CASE("pair: touching counts to the last step of the grid") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        const Blob& blob = cube.blob;
        // A grid step is 2^-6 of a lattice step, which is 2^-16 here; 24 bits hold both cubes.
        const float step = std::ldexp(1.0f, blob.lattice().step_exponent) * 0x1p-6f;
        CHECK(touch(blob, blob, {{}, {1.0f, 0.0f, 0.0f}, 1.0f}));
        CHECK(touch(blob, blob, {{}, {1.0f, 1.0f, 1.0f}, 1.0f}));
        CHECK_FALSE(touch(blob, blob, {{}, {1.0f + step, 0.0f, 0.0f}, 1.0f}));
        CHECK_FALSE(touch(blob, blob, {{}, {-1.0f, 0.25f, -1.0f - step}, 1.0f}));
        // The triangles are a surface: a cube inside a cube touches nothing.
        CHECK_FALSE(touch(blob, blob, {{}, {0.25f, 0.25f, 0.25f}, 0.5f}));
        CHECK(touch(blob, blob, {{}, {0.5f, 0.25f, 0.25f}, 0.5f}));
        CHECK(touch(blob, blob, {{0.0f, 0.0f, 1.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, 1.0f}));
    }

    TEST_CASE("pair: distances and witnesses of boxes match hand-computed values") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        const PlacedBlob aside(cube.blob, {{}, {4.0f, 5.0f, 13.0f}, 1.0f});
        const BlobDistance nearest = distance(cube.blob, aside, unlimited, 100.0f);
        CHECK(nearest);
        CHECK(nearest.distance == 13.0f);
        CHECK(nearest.on_a == Vec3{1.0f, 1.0f, 1.0f});
        CHECK(nearest.on_b == Vec3{4.0f, 5.0f, 13.0f});
        const float less = std::nextafter(13.0f, 0.0f);
        const BlobDistance none = distance(cube.blob, aside, unlimited, less);
        CHECK(none.status == QueryStatus::not_found);
        CHECK_FALSE(none);
        CHECK(none.distance == std::numeric_limits<float>::infinity());
        CHECK(none.a == no_triangle);
        CHECK(none.b == no_triangle);
        CHECK(within_distance(cube.blob, aside, 13.0f, unlimited).yes());
        CHECK(within_distance(cube.blob, aside, less, unlimited).no());
        // A scale of 2 and a quarter turn: the cube [0, 2] x [-2, 0] x [0, 2], 3 below.
        const PlacedBlob below(cube.blob, {{0.0f, 0.0f, -1.0f, 1.0f}, {0.0f, -3.0f, 0.0f}, 2.0f});
        CHECK(distance(cube.blob, below, unlimited).distance == 3.0f);
    }

    TEST_CASE("pair: two placed blobs have distances and witnesses in world space") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        // [10, 14] x [20, 24] x [-4, 0], and the unit cube on the other side of x = 0.
        const PlacedBlob a(cube.blob, {{0.0f, 1.0f, 0.0f, 1.0f}, {10.0f, 20.0f, 0.0f}, 4.0f});
        const PlacedBlob b(cube.blob, {{0.0f, 0.0f, 1.0f, 0.0f}, {0.0f, 20.5f, -2.0f}, 1.0f});
        const BlobDistance nearest = distance(a, b, unlimited);
        CHECK(nearest);
        CHECK(nearest.distance == 10.0f);
        CHECK(nearest.on_a.x == 10.0f);
        CHECK(nearest.on_b.x == 0.0f);
        CHECK(nearest.on_a.y == nearest.on_b.y);
        CHECK(nearest.on_a.z == nearest.on_b.z);
        CHECK(within_distance(a, b, 10.0f, unlimited).yes());
        CHECK(within_distance(a, b, 9.999f, unlimited).no());
        CHECK(overlaps(a, b, unlimited).no());
        CHECK(overlaps(a, {cube.blob, {{}, {13.5f, 23.5f, -0.5f}, 1.0f}}, unlimited).yes());
    }

    TEST_CASE("pair: moving both blobs by one rigid motion keeps their contacts") {
        const OpenedBlob sphere(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
        const Transform b_in_a = {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 0.75f};
        const Contacts expected = all_contacts(sphere.blob, {sphere.blob, b_in_a});
        CHECK(expected.size() > 20);
        // A quarter turn, a scale and a translation whose products floats hold exactly.
        const Transform both = {{0.0f, 0.0f, 1.0f, 1.0f}, {16.0f, -32.0f, 8.0f}, 2.0f};
        const Transform moved = {{-0.1f, 0.3f, 1.3f, 0.7f}, to_world(both, b_in_a.translation), 1.5f};
        CHECK(all_contacts({sphere.blob, both}, {sphere.blob, moved}) == expected);
    }

    TEST_CASE("pair: surfaces that pierce each other have distance 0 and one common witness") {
        const OpenedBlob flat(one_triangle({0.0f, 0.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}));
        const OpenedBlob upright(one_triangle({1.0f, 1.0f, -1.0f}, {1.0f, 1.0f, 3.0f}, {9.0f, 9.0f, 9.0f}));
        const BlobDistance nearest = distance(flat.blob, upright.blob, unlimited, 0.0f);
        CHECK(nearest);
        CHECK(nearest.distance == 0.0f);
        CHECK(std::abs(nearest.on_a.z) < 1e-4f);
        CHECK(std::abs(nearest.on_b.z) < 1e-4f);
        CHECK(std::abs(nearest.on_a.x - nearest.on_b.x) < 1e-4f);
    }

    TEST_CASE("pair: a full array reports that there are more and the next page goes on") {
        const OpenedBlob sphere(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
        const PlacedBlob other(sphere.blob, {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f});
        const Contacts all = all_contacts(sphere.blob, other);
        CHECK(all.size() > 20);
        Contacts few(all.size());
        const Filled complete = collect_contacts(sphere.blob, other, few, unlimited);
        CHECK(complete.status == QueryStatus::ok);
        CHECK(complete.count == all.size());
        CHECK(few == all);
        few.resize(all.size() - 1);
        const Filled most = collect_contacts(sphere.blob, other, few, unlimited);
        CHECK(most.status == QueryStatus::output_full);
        CHECK(most.count == all.size() - 1);
        CHECK(std::equal(few.begin(), few.end(), all.begin()));
        const Filled last = collect_contacts(sphere.blob, other, few, unlimited, most.next);
        CHECK(last.status == QueryStatus::ok);
        CHECK(last.count == 1);
        CHECK(few[0] == all.back());
        CHECK(collect_contacts(sphere.blob, other, few, unlimited, last.next).count == 0);
        const Filled none = collect_contacts(sphere.blob, other, {}, unlimited);
        CHECK(none.status == QueryStatus::output_full);
        CHECK(none.count == 0);
        CHECK(none.next == Cursor{});
        std::size_t visited = 0;
        const auto stop_at_five = [&](const PairContact&) { return ++visited == 5 ? Visit::stop : Visit::next; };
        CHECK(for_each_contact(sphere.blob, other, stop_at_five, unlimited) == QueryStatus::stopped);
        CHECK(visited == 5);
    }

    TEST_CASE("pair: pages under a work limit resume and a limit that is too small makes no progress") {
        const OpenedBlob sphere(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
        const PlacedBlob other(sphere.blob, {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f});
        const Contacts all = all_contacts(sphere.blob, other);
        Contacts page(7), found;
        Cursor from;
        unsigned limited = 0;
        for (std::uint64_t visits = 1;;) {
            const Filled filled = collect_contacts(sphere.blob, other, page, WorkLimit(visits), from);
            found.insert(found.end(), page.begin(), page.begin() + static_cast<std::ptrdiff_t>(filled.count));
            if (filled.status == QueryStatus::ok) break;
            limited += filled.status == QueryStatus::work_limit && filled.count > 0 ? 1u : 0u;
            CHECK((filled.next == from) == (filled.count == 0));
            if (filled.next == from) visits *= 2;
            from = filled.next;
            REQUIRE(visits < 100'000);
        }
        CHECK(found == all);
        CHECK(limited > 0);
        const Filled stuck = collect_contacts(sphere.blob, other, page, WorkLimit(1), from);
        CHECK(stuck.status == QueryStatus::work_limit);
        CHECK(stuck.count == 0);
        CHECK(stuck.next == from);
        CHECK(overlaps(sphere.blob, other, WorkLimit(1)).status() == QueryStatus::work_limit);
        CHECK_FALSE(is_refused(overlaps(sphere.blob, other, WorkLimit(1)).status()));
    }

    TEST_CASE("pair: a page costs the way to it and its own work") {
        const OpenedBlob sphere(make_icosphere(4, 1.0, {0.0f, 0.0f, 0.0f}));
        const PlacedBlob other(sphere.blob, {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f});
        const Contacts all = all_contacts(sphere.blob, other);
        Contacts most(all.size() - 4), page(2);
        const Filled long_page = collect_contacts(sphere.blob, other, most, unlimited);
        REQUIRE(long_page.status == QueryStatus::output_full);
        const WorkLimit few(2 * sphere.blob.depth() + 60);
        const Filled next = collect_contacts(sphere.blob, other, page, few, long_page.next);
        CHECK(next.status == QueryStatus::output_full);
        CHECK(page == Contacts{all[all.size() - 4], all[all.size() - 3]});
        CHECK(collect_contacts(sphere.blob, other, most, few).status == QueryStatus::work_limit);
    }

    TEST_CASE("pair: a cursor of no page is refused or gives contacts of the whole") {
        const OpenedBlob sphere(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
        const PlacedBlob other(sphere.blob, {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f});
        const Contacts all = all_contacts(sphere.blob, other);
        const std::uint32_t count = sphere.blob.triangle_count();
        const auto resume = [&](Cursor from) {
            Contacts page(all.size());
            const Filled filled = collect_contacts(sphere.blob, other, page, unlimited, from);
            for (const PairContact& pair : filled.in(page)) CHECK(std::find(all.begin(), all.end(), pair) != all.end());
            return filled;
        };
        CHECK(resume({{count, 0, 1}}).status == QueryStatus::invalid_argument);
        CHECK(resume({{0, count, 1}}).status == QueryStatus::invalid_argument);
        CHECK(resume({{0, 0, 2}}).status == QueryStatus::invalid_argument);
        CHECK(resume({{~0u, ~0u, ~0u}}).status == QueryStatus::invalid_argument);
        std::size_t refused = 0;
        for (std::uint32_t a = 0; a < count; a += 7) {
            const Filled filled = resume({{a, (5 * a) % count, 1}});
            CHECK((filled.status == QueryStatus::ok || filled.count == 0));
            refused += filled.status == QueryStatus::invalid_argument ? 1u : 0u;
        }
        CHECK(refused > 0);
    }

    TEST_CASE("pair: a work limit is kept and the contacts found are part of the whole") {
        const OpenedBlob sphere(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}));
        const PlacedBlob other(sphere.blob, {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f});
        const Contacts all = all_contacts(sphere.blob, other);
        Contacts part(all.size());
        const Filled filled = collect_contacts(sphere.blob, other, part, WorkLimit(50));
        CHECK(filled.status == QueryStatus::work_limit);
        CHECK(filled.count < all.size());
        CHECK(std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(filled.count), all.begin()));
        const YesNo undecided = overlaps(sphere.blob, other, WorkLimit(0));
        CHECK(undecided.status() == QueryStatus::work_limit);
        CHECK_FALSE(undecided.yes());
        CHECK_FALSE(undecided.no());
        const PairContact contact = first_contact(sphere.blob, other, WorkLimit(0));
        CHECK_FALSE(contact);
        CHECK(contact.a == no_triangle);
        CHECK(overlaps(sphere.blob, {sphere.blob, {{}, {100.0f, 0.0f, 0.0f}, 1.0f}}, WorkLimit(1)).no());
        const BlobDistance bound = distance(sphere.blob, {sphere.blob, {{}, {9.0f, 0.0f, 0.0f}, 1.0f}}, WorkLimit(3));
        CHECK(bound.status == QueryStatus::work_limit);
        CHECK(bound.distance > 0.0f);
    }

    TEST_CASE("pair: invalid calls are refused and a refusal is not a no") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        const Blob& blob = cube.blob;
        const float infinity = std::numeric_limits<float>::infinity();
        const float nan = std::numeric_limits<float>::quiet_NaN();
        // The same for either blob, since the other one stands at the origin.
        const auto status = [&](const Transform& placement) {
            const YesNo answer = overlaps(blob, {blob, placement}, unlimited);
            CHECK(answer.no() == (answer.status() == QueryStatus::not_found));
            const YesNo exchanged = overlaps({blob, placement}, blob, unlimited);
            CHECK(is_refused(exchanged.status()) == is_refused(answer.status()));
            return answer.status();
        };
        CHECK(status({{0.0f, 0.0f, 0.0f, 0.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{0.0f, nan, 0.0f, 1.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{0.0f, infinity, 0.0f, 1.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {0.0f, 0.0f, -infinity}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {0.0f, nan, 0.0f}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {}, 0.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {}, -1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {}, nan}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {1e35f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::out_of_range);
        CHECK(status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::not_found);
        CHECK(overlaps(blob, {blob, {{}, {}, 1e35f}}, unlimited).status() == QueryStatus::out_of_range);
        CHECK(overlaps({blob, {{}, {}, 0x1p-101f}}, blob, unlimited).status() == QueryStatus::out_of_range);
        CHECK(overlaps({blob, {{}, {-3e38f, 0, 0}, 1}}, {blob, {{}, {3e38f, 0, 0}, 1}}, unlimited).status() ==
              QueryStatus::out_of_range);
        const auto distance_status = [&](const Transform& placement, float most) {
            const PlacedBlob other(blob, placement);
            const QueryStatus decided = within_distance(blob, other, most, unlimited).status();
            CHECK(distance(blob, other, unlimited, most).status == decided);
            return decided;
        };
        CHECK(distance_status({}, nan) == QueryStatus::invalid_argument);
        CHECK(distance_status({}, -1.0f) == QueryStatus::invalid_argument);
        CHECK(distance_status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, infinity) == QueryStatus::out_of_range);
        CHECK(distance_status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, 1.0f) == QueryStatus::not_found);
        // Subnormal components turn as well as any.
        const float tiny = std::numeric_limits<float>::denorm_min();
        CHECK(status({{0.0f, 0.0f, tiny, tiny}, {2.0f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::ok);
        CHECK(PairContact().status == QueryStatus::not_open);
        CHECK(BlobDistance().status == QueryStatus::not_open);
    }

    TEST_CASE("pair: a blob that was never opened is refused and one without triangles touches nothing") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        const OpenedBlob empty(Mesh{}, {});
        REQUIRE(empty.blob.triangle_count() == 0);
        const Blob never_opened;
        const Transform invalid = {{}, {}, std::numeric_limits<float>::quiet_NaN()};
        const auto check = [](const PlacedBlob& a, const PlacedBlob& b, QueryStatus one, QueryStatus list) {
            PairContact page[1];
            CHECK(overlaps(a, b, unlimited).status() == one);
            CHECK(first_contact(a, b, unlimited).status == one);
            CHECK(distance(a, b, unlimited).status == one);
            CHECK(within_distance(a, b, 1.0f, unlimited).status() == one);
            CHECK(for_each_contact(
                      a, b, [](const PairContact&) {}, unlimited) == list);
            CHECK(collect_contacts(a, b, page, unlimited).status == list);
        };
        check(never_opened, cube.blob, QueryStatus::not_open, QueryStatus::not_open);
        check(cube.blob, never_opened, QueryStatus::not_open, QueryStatus::not_open);
        check(cube.blob, {never_opened, invalid}, QueryStatus::not_open, QueryStatus::not_open);
        check(empty.blob, cube.blob, QueryStatus::not_found, QueryStatus::ok);
        check(cube.blob, empty.blob, QueryStatus::not_found, QueryStatus::ok);
        check(cube.blob, {empty.blob, invalid}, QueryStatus::invalid_argument, QueryStatus::invalid_argument);
    }

    TEST_CASE("pair: a work limit counts the walks for duplicate references and pages resume behind it") {
        BakeOptions options = with_profile(Profile::fast);
        options.build.builder = Builder::spatial_splits;
        options.build.duplicate_budget = 1.0;
        const OpenedBlob split(make_soup(400, 21), options);
        const PlacedBlob other(split.blob, {{0.1f, 0.2f, 0.3f, 1.0f}, {0.25f, 0.125f, 0.0f}, 1.0f});
        const Contacts all = all_contacts(split.blob, other);
        const auto list = [&](std::uint64_t visits, Contacts& contacts) {
            contacts.clear();
            return for_each_contact(
                split.blob, other, [&](const PairContact& pair) { contacts.push_back(pair); }, WorkLimit(visits));
        };
        Contacts part;
        std::uint64_t less = 0, least = std::uint64_t{1} << 24;
        while (least - less > 1) {
            const std::uint64_t middle = less + (least - less) / 2;
            const QueryStatus status = list(middle, part);
            REQUIRE((status == QueryStatus::ok || status == QueryStatus::work_limit));
            REQUIRE(part.size() <= all.size());
            REQUIRE(std::equal(part.begin(), part.end(), all.begin()));
            (status == QueryStatus::ok ? least : less) = middle;
        }
        TestPairFrame frame;
        const detail::BlobData& data = detail::data_of(split.blob);
        REQUIRE(detail::place_pair(data, data, other.transform(), frame) == QueryStatus::ok);
        std::uint64_t references = 0;
        const auto count = [&](const detail::TrianglePair&) { ++references; };
        for (const InstructionPath& path : instruction_paths()) {
            std::uint64_t left = least;
            references = 0;
            REQUIRE(path.touching_pairs(frame, count, left) == QueryStatus::ok);
            CHECK(left > references - all.size());
        }
        CHECK(references > all.size());
        Contacts paged, page(all.size());
        Cursor from;
        for (int pages = 0; pages < 100; ++pages) {
            const Filled filled = collect_contacts(split.blob, other, page, WorkLimit(least / 3), from);
            paged.insert(paged.end(), page.begin(), page.begin() + static_cast<std::ptrdiff_t>(filled.count));
            from = filled.next;
            if (filled.status == QueryStatus::ok) break;
            REQUIRE(filled.status == QueryStatus::work_limit);
        }
        CHECK(paged == all);
    }

    TEST_CASE("pair: blobs with duplicate references answer as those without") {
        BakeOptions options = with_profile(Profile::fast);
        options.build.builder = Builder::spatial_splits;
        options.build.duplicate_budget = 1.0;
        const OpenedBlob split(make_soup(400, 21), options);
        REQUIRE(split.blob.duplicate_reference_count() > 0);
        const OpenedBlob plain(make_soup(400, 21), with_profile(Profile::fast));
        const DecodedBlob split_decoded = decode(split.bytes);
        PlacementMaker maker(split_decoded, split_decoded, 77);
        std::size_t touching = 0;
        for (int i = 0; i < 60; ++i) {
            const Transform placement = i % 2 == 0 ? maker.random() : maker.adversarial();
            CAPTURE(describe(placement));
            const PlacedBlob split_b(split.blob, placement), plain_b(plain.blob, placement);
            const YesNo answer = overlaps(split.blob, plain_b, unlimited);
            REQUIRE(answer == overlaps(plain.blob, plain_b, unlimited));
            touching += answer.yes() ? 1u : 0u;
            const BlobDistance nearest = distance(split.blob, split_b, unlimited, 1e30f);
            const BlobDistance plain_nearest = distance(plain.blob, plain_b, unlimited, 1e30f);
            REQUIRE(nearest.status == plain_nearest.status);
            REQUIRE(nearest.distance == plain_nearest.distance);
            const auto is_owner = [&](TriangleId id) { return split_decoded.owners[id.index] == id.index; };
            if (nearest) REQUIRE((is_owner(nearest.a) && is_owner(nearest.b)));
            if (is_refused(answer.status())) continue;
            Contacts listed = all_contacts(split.blob, split_b);
            for (const PairContact& pair : listed) REQUIRE((is_owner(pair.a) && is_owner(pair.b)));
            const auto by_ids = [](const PairContact& x, const PairContact& y) {
                return x.a != y.a ? x.a < y.a : x.b < y.b;
            };
            std::sort(listed.begin(), listed.end(), by_ids);
            REQUIRE(std::adjacent_find(listed.begin(), listed.end()) == listed.end());
            REQUIRE(listed.size() == all_contacts(plain.blob, plain_b).size());
        }
        CHECK(touching > 5);
    }
}
