// Claims about the counters of queries of two blobs.
#include "support/testing.hpp"

#include <tuple>

#include <espalier/advanced/statistics.hpp>

#include "support/machine/chosen_instruction_set.hpp"
#include "support/queries/placement_maker.hpp"

namespace espalier::tests::pairs_counters_test {
namespace {

constexpr WorkLimit unlimited = WorkLimit::unlimited();

using Counts = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>;

Counts counts_of(const PairCounters& counters) {
    return {counters.box_pairs, counters.leaf_pairs, counters.triangle_pairs};
}

/// What the queries of two blobs with one limit return, and their work.
struct Outcome {
    PairCounters of_contact;
    PairCounters of_distance;
    PairContact contact;
    BlobDistance nearest;

    Outcome(const PlacedBlob& a, const PlacedBlob& b, float max_distance, WorkLimit for_contact, WorkLimit for_distance)
        : contact(first_contact(a, b, for_contact, of_contact)),
          nearest(distance(a, b, for_distance, max_distance, of_distance)) {}
    Outcome(const PlacedBlob& a, const PlacedBlob& b, float max_distance, WorkLimit limit)
        : Outcome(a, b, max_distance, limit, limit) {}
};

bool same_distance(const BlobDistance& x, const BlobDistance& y) {
    return same_bits(x.distance, y.distance) && same_bits(x.on_a, y.on_a) && same_bits(x.on_b, y.on_b) && x.a == y.a &&
           x.b == y.b && x.status == y.status;
}

/// Calls with places of a mesh beside another: some where they touch, some apart, some hard to answer.
template <class Call>
void for_each_place(Profile profile, std::uint64_t count, Call call) {
    const OpenedBlob a(make_terrain(16, 5), with_profile(profile)), b(make_icosphere(2, 0.7, {}));
    const DecodedBlob decoded_a = decode(a.bytes), decoded_b = decode(b.bytes);
    PlacementMaker maker(decoded_a, decoded_b, 21);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Transform placement = i % 3 == 0 ? maker.random() : i % 3 == 1 ? maker.apart() : maker.adversarial();
        CAPTURE(describe(placement));
        call(PlacedBlob(a.blob), PlacedBlob(b.blob, placement));
    }
}

OpenedBlob with_leaves_of(const Mesh& mesh, unsigned triangles) {
    const BakeOptions options = {.profile = Profile::fast, .build = {.max_leaf_triangles = triangles}};
    return {mesh, options};
}

/// Returns the unlimited counts of both queries together.
PairCounters work_of(const PlacedBlob& a, const PlacedBlob& b) {
    PairCounters counters;
    REQUIRE(first_contact(a, b, unlimited, counters).status != QueryStatus::work_limit);
    REQUIRE(distance(a, b, unlimited, infinity, counters));
    return counters;
}

TEST_CASE("work: counted queries of two blobs return what the others do and count alike on every instruction set") {
    for_each_profile([](Profile profile) {
        std::uint64_t touching = 0, apart = 0, leaf_pairs = 0;
        for_each_place(profile, scaled_share(120), [&](const PlacedBlob& a, const PlacedBlob& b) {
            for (const float max_distance : {infinity, 0.25f, 0.0f}) {
                for (const WorkLimit limit : {unlimited, WorkLimit(40)}) {
                    const Outcome expected(a, b, max_distance, limit);
                    on_each_instruction_set([&] {
                        const Outcome outcome(a, b, max_distance, limit);
                        CHECK(outcome.contact == first_contact(a, b, limit));
                        CHECK(same_distance(outcome.nearest, distance(a, b, limit, max_distance)));
                        CHECK(counts_of(outcome.of_contact) == counts_of(expected.of_contact));
                        CHECK(counts_of(outcome.of_distance) == counts_of(expected.of_distance));
                    });
                    ++(expected.contact ? touching : apart);
                    leaf_pairs += expected.of_contact.leaf_pairs;
                }
            }
        });
        CHECK(touching > 0);
        CHECK(apart > 0);
        CHECK(leaf_pairs >= touching);
    });
}

TEST_CASE("work: the counted pairs of boxes are the smallest limit with which a query of two blobs is complete") {
    for_each_profile([](Profile profile) {
        for_each_place(profile, scaled_share(120), [](const PlacedBlob& a, const PlacedBlob& b) {
            const Outcome whole(a, b, infinity, unlimited);
            if (is_refused(whole.contact.status) || is_refused(whole.nearest.status)) return;
            const std::uint64_t of_contact = whole.of_contact.box_pairs, of_distance = whole.of_distance.box_pairs;
            REQUIRE(of_contact > 0);
            // A distance begins with the search for a contact.
            REQUIRE(of_distance >= of_contact);
            const Outcome enough(a, b, infinity, WorkLimit(of_contact), WorkLimit(of_distance));
            CHECK(enough.contact == whole.contact);
            CHECK(same_distance(enough.nearest, whole.nearest));
            CHECK(counts_of(enough.of_contact) == counts_of(whole.of_contact));
            CHECK(counts_of(enough.of_distance) == counts_of(whole.of_distance));
            const Outcome short_by_one(a, b, infinity, WorkLimit(of_contact - 1), WorkLimit(of_distance - 1));
            CHECK(short_by_one.contact.status == QueryStatus::work_limit);
            CHECK(short_by_one.of_contact.box_pairs == of_contact - 1);
            CHECK(short_by_one.nearest.status == QueryStatus::work_limit);
            CHECK(short_by_one.of_distance.box_pairs == of_distance - 1);
        });
    });
}

TEST_CASE("work: each call for two blobs adds the same to its counters") {
    for_each_place(Profile::balanced, scaled(30), [](const PlacedBlob& a, const PlacedBlob& b) {
        const Outcome once(a, b, infinity, unlimited);
        PairCounters counters = {1, 20, 300};
        for (int i = 0; i < 3; ++i) {
            (void)first_contact(a, b, unlimited, counters);
            (void)distance(a, b, unlimited, infinity, counters);
        }
        const PairCounters &x = once.of_contact, &y = once.of_distance;
        CHECK(counters.box_pairs == 1 + 3 * (x.box_pairs + y.box_pairs));
        CHECK(counters.leaf_pairs == 20 + 3 * (x.leaf_pairs + y.leaf_pairs));
        CHECK(counters.triangle_pairs == 300 + 3 * (x.triangle_pairs + y.triangle_pairs));
    });
}

TEST_CASE("work: refused queries of two blobs and those without triangles count nothing") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f)), nothing{Mesh()};
    const Blob not_open;
    const Transform turned_by_nothing = {{0.0f, 0.0f, 0.0f, 0.0f}, {}, 1.0f};
    const Transform far_away = {{}, {1e36f, 0.0f, 0.0f}, 1.0f};
    const auto check = [](const PlacedBlob& a, const PlacedBlob& b, float max_distance, QueryStatus contact_status,
                          QueryStatus distance_status) {
        const Outcome outcome(a, b, max_distance, unlimited);
        CHECK(outcome.nearest.status == distance_status);
        CHECK(counts_of(outcome.of_distance) == Counts{});
        CHECK(outcome.contact.status == contact_status);
        if (contact_status != QueryStatus::ok) CHECK(counts_of(outcome.of_contact) == Counts{});
    };
    const auto check_both = [&](const PlacedBlob& a, const PlacedBlob& b, QueryStatus status) {
        check(a, b, infinity, status, status);
        check(b, a, infinity, status, status);
    };
    check_both(cube.blob, not_open, QueryStatus::not_open);
    check_both(cube.blob, {cube.blob, turned_by_nothing}, QueryStatus::invalid_argument);
    check_both({cube.blob, turned_by_nothing}, nothing.blob, QueryStatus::invalid_argument);
    check_both(cube.blob, {cube.blob, far_away}, QueryStatus::out_of_range);
    check_both(cube.blob, nothing.blob, QueryStatus::not_found);
    check(cube.blob, cube.blob, -1.0f, QueryStatus::ok, QueryStatus::invalid_argument);
}

TEST_CASE("work: pairs of triangles are counted by the sizes of the leaves that were compared") {
    const Mesh sphere = make_icosphere(2, 1.0, {}), cube = make_cube(-0.5f, 0.5f);
    const OpenedBlob ones = with_leaves_of(sphere, 1), whole = with_leaves_of(cube, 12);
    REQUIRE(decode(whole.bytes).triangles_in_leaf == std::vector<std::uint8_t>{12});
    const Transform apart = {{0.1f, 0.2f, 0.3f, 1.0f}, {1.9f, 0.3f, 0.2f}, 1.0f};
    for (const Transform& placement : {Transform{}, apart}) {
        const PairCounters single = work_of(ones.blob, {ones.blob, placement});
        CHECK(single.leaf_pairs > 1);
        CHECK(single.triangle_pairs == single.leaf_pairs);
        const PairCounters twelve = work_of(ones.blob, {whole.blob, placement});
        CHECK(twelve.leaf_pairs > 1);
        CHECK(twelve.triangle_pairs == 12 * twelve.leaf_pairs);
        const PairCounters both = work_of(whole.blob, {whole.blob, placement});
        CHECK(both.triangle_pairs == 144 * both.leaf_pairs);
    }
}

TEST_CASE("work: two blobs take the recorded work also in small code") {
    // A change of the tree or of the walk changes these numbers; small code must have the same.
    struct Recorded {
        Profile profile;
        Counts contact, apart, nearest;
    };
    const Recorded all[] = {{Profile::fast, {4, 1, 208}, {94, 49, 8622}, {290, 153, 26854}},
                            {Profile::small, {6, 2, 2775}, {54, 28, 38200}, {170, 74, 102961}}};
    for (const Recorded& recorded : all) {
        const OpenedBlob large(make_icosphere(4, 1.0, {}), with_profile(recorded.profile));
        const OpenedBlob small(make_icosphere(3, 0.7, {}), with_profile(recorded.profile));
        const Quaternion rotation = {0.1f, 0.2f, 0.3f, 1.0f};
        const Outcome touching(large.blob, {small.blob, {rotation, {1.2f, 0.9f, 0.7f}, 1.0f}}, infinity, unlimited);
        const Outcome apart(large.blob, {small.blob, {rotation, {1.2f, 1.0f, 0.8f}, 1.0f}}, infinity, unlimited);
        CHECK(touching.contact.status == QueryStatus::ok);
        CHECK(apart.contact.status == QueryStatus::not_found);
        CHECK(counts_of(touching.of_contact) == recorded.contact);
        CHECK(counts_of(apart.of_contact) == recorded.apart);
        CHECK(counts_of(apart.of_distance) == recorded.nearest);
    }
}

TEST_CASE("work: two leaves below their roots are three pairs of boxes") {
    const OpenedBlob cube = with_leaves_of(make_cube(-1.0f, 1.0f), 12);
    PairCounters counters;
    REQUIRE(first_contact(cube.blob, cube.blob, unlimited, counters));
    // Both roots, a leaf beside a root, both leaves.
    CHECK(counts_of(counters) == Counts{3, 1, 144});
    counters = {};
    REQUIRE_FALSE(first_contact(cube.blob, {cube.blob, {{}, {9.0f, 0.0f, 0.0f}, 1.0f}}, unlimited, counters));
    CHECK(counts_of(counters) == Counts{1, 0, 0});
}

}  // namespace
}  // namespace espalier::tests::pairs_counters_test
