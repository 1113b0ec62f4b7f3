// Claims about lists of contacts of two blobs: pages, cursors and work limits.
#include "support/testing.hpp"

#include "contacts.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/test_pair_frame.hpp"

namespace espalier::tests::pages_test {
namespace {

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
    const PlacedBlob far_away(sphere.blob, {{}, {9.0f, 0.0f, 0.0f}, 1.0f});
    Contacts page(1);
    CHECK(collect_contacts(sphere.blob, far_away, page, unlimited, {{~0u, ~0u, ~0u}}).status ==
          QueryStatus::invalid_argument);
    CHECK(collect_contacts(sphere.blob, far_away, page, unlimited, {{0, 0, 1}}).status ==
          QueryStatus::invalid_argument);
    CHECK(collect_contacts(sphere.blob, far_away, page, unlimited).status == QueryStatus::ok);
}

TEST_CASE("pair: a cursor whose triangles are in boxes that are apart is refused on the way to them") {
    const OpenedBlob sphere(make_icosphere(4, 1.0, {0.0f, 0.0f, 0.0f}));
    const PlacedBlob other(sphere.blob, {{}, {0.5f, 0.25f, 0.125f}, 1.0f});
    TriangleId low, high;  // the triangles with the lowest corner and with the highest one
    float least = 2.0f, most = -2.0f;
    (void)for_each_triangle(sphere.blob, [&](TriangleId triangle, const Triangle& corners) {
        if (corners.a.x < least) least = corners.a.x, low = triangle;
        if (corners.a.x > most) most = corners.a.x, high = triangle;
        return Visit::next;
    });
    REQUIRE(least < -0.9f);
    REQUIRE(most > 0.9f);
    // The way takes a step at most for each level of either tree; a walk to the end, many more.
    const WorkLimit enough(2 * sphere.blob.depth());
    Contacts page(10);
    const auto resume = [&](TriangleId a, TriangleId b) {
        return collect_contacts(sphere.blob, other, page, enough, {{a.index, b.index, 1}});
    };
    for (const Filled& filled : {resume(low, high), resume(high, low), resume(low, low)}) {
        CHECK(filled.status == QueryStatus::invalid_argument);
        CHECK(filled.count == 0);
    }
    CHECK(collect_contacts(sphere.blob, other, page, enough).status == QueryStatus::work_limit);
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

TEST_CASE("pair: a work limit counts the walks for duplicate references and pages resume behind it") {
    const OpenedBlob split(make_soup(400, 21), with_copies());
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

}  // namespace
}  // namespace espalier::tests::pages_test
