// Claims about how much queries look at: an order or a culling that is a little wrong changes no answer. Counted only
// in builds with ESPALIER_COUNT_STEPS, as those with sanitizers, with mutants and of small code are.
#include "support/testing.hpp"

#include <runtime/base/options.hpp>
#include <runtime/lanes/select.hpp>

#include "platform/answers.hpp"
#include "support/machine/chosen_instruction_set.hpp"

namespace espalier::tests::work_test {
namespace {

#if ESPALIER_COUNT_STEPS && !ESPALIER_NEON

struct Work {
    std::uint64_t nodes, leaves, decisions, axes = 0;
};

using AskSome = void (*)(const Blob&, platform::Questions&, std::uint32_t, platform::Answers&);

void ask_contacts(const Blob& blob, platform::Questions& questions, std::uint32_t count, platform::Answers&) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Transform placement = questions.placement(number, blob);
        PairContact pairs[8];
        (void)collect_contacts(blob, {blob, placement}, pairs, WorkLimit::unlimited());
        (void)overlaps(blob, {blob, placement}, WorkLimit::unlimited());
        (void)first_contact(blob, {blob, placement}, WorkLimit::unlimited());
    }
}

void ask_distances(const Blob& blob, platform::Questions& questions, std::uint32_t count, platform::Answers&) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Transform placement = questions.placement(number, blob);
        (void)distance(blob, {blob, placement}, WorkLimit::unlimited(), questions.distance(number));
        (void)within_distance(blob, {blob, placement}, questions.distance(1), WorkLimit::unlimited());
    }
}

void ask_pages(const Blob& blob, platform::Questions& questions, std::uint32_t count, platform::Answers&) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Sphere sphere = questions.sphere(number);
        TriangleId places[16];
        Filled page = {0, {}, QueryStatus::output_full};
        const auto out = std::span(places).first(1 + number % 16);
        while (page.status == QueryStatus::output_full) page = collect_overlaps(blob, sphere, out, page.next);
    }
}

struct Group {
    std::string query;
    AskSome ask;
    std::uint32_t count;
    Work expected, expected_of_small_code = {};
};

void check_work(const Blob& blob, detail::InstructionSet set, const std::vector<Group>& groups) {
    const ChosenInstructionSet lanes(set);
    for (const Group& group : groups) {
        CAPTURE(group.query);
        platform::Questions questions(blob);
        platform::Answers answers;
        detail::step_counter = {};
        group.ask(blob, questions, group.count, answers);
        const detail::StepCounter counted = detail::step_counter;
        // Without lanes x86 answers single rays by the walk of small cores, whose leaves are others.
        const bool has_small_walk = set == detail::InstructionSet::scalar && !detail::has_fast_scalar &&
                                    group.expected_of_small_code.axes != group.expected.axes;
        const Work& expected = has_small_walk || detail::small_code ? group.expected_of_small_code : group.expected;
        CHECK(counted.nodes == expected.nodes);
        CHECK(counted.axes == expected.axes);
        if (has_small_walk && !detail::small_code) continue;
        CHECK(counted.leaves == expected.leaves);
        CHECK(counted.decisions == expected.decisions);
    }
}

OpenedBlob terrain_of(unsigned bits) {
    return {make_terrain(24, 7), {.resolution = Resolution::bits(bits), .profile = Profile::fast}};
}
OpenedBlob torus() {
    return {make_torus(32, 16, 3.0, 1.0), {.resolution = Resolution::bits(12), .profile = Profile::balanced}};
}

TEST_CASE("contact: a ball at the tip of thousands of triangles takes work in proportion to their number") {
    const auto decisions_at = [](std::uint32_t number) {
        Mesh tip;
        tip.positions.push_back({});
        for (std::uint32_t i = 0; i < number; ++i) {
            const double angle = 2.0 * 3.14159265358979 * i / number;
            tip.positions.push_back(
                {static_cast<float>(4.0 * std::cos(angle)), static_cast<float>(4.0 * std::sin(angle)), -0.1f});
            tip.triangles.push_back({0, 1 + i, 1 + (i + 1) % number});
        }
        const OpenedBlob blob(tip, {.flat_angle = 5.0});
        std::vector<Contact> room(number);
        detail::step_counter = {};
        REQUIRE(find_contacts(blob.blob, Sphere{{0.01f, 0.02f, 0.3f}, 0.5f}, 0.05f, room).count > 0);
        return detail::step_counter.decisions;
    };
    CHECK(decisions_at(4000) < 3 * decisions_at(2000));
}

TEST_CASE("work: queries of a terrain visit the recorded numbers of nodes and leaves") {
    const OpenedBlob landscape = terrain_of(18);
    check_work(landscape.blob, detail::InstructionSet::scalar,
               {{"closest hits", platform::ask_closest_hits, 200, {680, 793, 2172}, {1029, 707, 795, 13146}},
                {"filtered and any hits", platform::ask_filtered_hits, 100, {745, 772, 1597}, {929, 728, 823, 17572}},
                {"all hits", platform::ask_all_hits, 100, {336, 463, 1264}, {343, 424, 443, 6212}},
                {"first hits", platform::ask_first_hits, 50, {359, 354, 800}, {504, 335, 319, 8150}},
                {"batches", platform::ask_batches, 60, {2929, 2464, 3650}, {3774, 2335, 2714, 72468}},
                {"sweeps", platform::ask_sweeps, 20, {646, 1305, 445}, {646, 1292, 46}},
                {"spheres", platform::ask_spheres, 100, {426, 456, 1183}, {426, 432, 970}},
                {"pages", ask_pages, 100, {2773, 25346, 1084}, {2773, 25322, 4886}},
                {"volumes", platform::ask_volumes, 30, {1876, 2191, 3822}, {1876, 2153, 3968}},
                {"approximate queries", platform::ask_approximately, 50, {434, 653, 4062}, {436, 576, 2959, 2110}},
                {"closest points", platform::ask_closest_points, 100, {459, 1123, 8867}, {459, 941, 7433}},
                {"segments and boxes", platform::ask_closest_pairs, 25, {130, 162, 151}, {130, 151, 17}},
                {"contacts", ask_contacts, 40, {944, 547, 0, 75960}, {944, 547, 0, 75960}},
                {"distances", ask_distances, 10, {204, 156, 0, 12000}, {204, 156, 0, 12000}}});
}

TEST_CASE("work: queries of a closed body visit the recorded numbers of nodes and leaves") {
    const OpenedBlob body = torus();
    check_work(body.blob, detail::InstructionSet::scalar,
               {{"closest hits", platform::ask_closest_hits, 200, {687, 747, 1391}, {1139, 657, 1058, 8576}},
                {"filtered and any hits", platform::ask_filtered_hits, 100, {865, 919, 1257}, {1134, 903, 1463, 12414}},
                {"all hits", platform::ask_all_hits, 100, {382, 501, 845}, {391, 477, 822, 4650}},
                {"first hits", platform::ask_first_hits, 50, {383, 361, 474}, {587, 326, 517, 5570}},
                {"batches", platform::ask_batches, 60, {3009, 2731, 3649}, {4199, 2680, 4046, 43400}},
                {"sweeps", platform::ask_sweeps, 20, {652, 1042, 155}, {652, 1034, 16}},
                {"spheres", platform::ask_spheres, 100, {434, 368, 577}, {434, 344, 976}},
                {"pages", ask_pages, 100, {2901, 13335, 498}, {2901, 13311, 4422}},
                {"volumes", platform::ask_volumes, 30, {2077, 2393, 3756}, {2077, 2351, 4461}},
                {"approximate queries", platform::ask_approximately, 50, {455, 606, 5216}, {457, 548, 4376, 1272}},
                {"closest points", platform::ask_closest_points, 100, {987, 1916, 21048}, {987, 1708, 18066}},
                {"segments and boxes", platform::ask_closest_pairs, 25, {140, 169, 70}, {140, 161, 13}},
                {"contacts", ask_contacts, 40, {569, 303, 0, 39459}, {569, 303, 0, 39459}},
                {"distances", ask_distances, 10, {187, 184, 0, 7926}, {187, 184, 0, 7926}}});
}

#if ESPALIER_X86
TEST_CASE("work: four lanes leave the recorded number of triangles undecided") {
    if (best_instruction_set() < detail::InstructionSet::sse42) return;
    const OpenedBlob landscape = terrain_of(18);
    check_work(landscape.blob, detail::InstructionSet::sse42,
               {{"closest hits", platform::ask_closest_hits, 200, {680, 793, 859}},
                {"batches", platform::ask_batches, 60, {2849, 2026, 2446}},
                {"spheres", platform::ask_spheres, 100, {426, 456, 437}},
                {"closest points", platform::ask_closest_points, 100, {459, 1123, 7714}},
                {"contacts", ask_contacts, 40, {944, 547, 0, 29538}},
                {"distances", ask_distances, 10, {204, 156, 0, 4335}}});
    const OpenedBlob body = torus();
    check_work(body.blob, detail::InstructionSet::sse42,
               {{"closest hits", platform::ask_closest_hits, 200, {687, 747, 894}},
                {"batches", platform::ask_batches, 60, {3024, 2343, 3083}},
                {"spheres", platform::ask_spheres, 100, {434, 368, 342}},
                {"closest points", platform::ask_closest_points, 100, {987, 1916, 18807}},
                {"contacts", ask_contacts, 40, {569, 303, 0, 14802}},
                {"distances", ask_distances, 10, {187, 184, 0, 2862}}});
}

TEST_CASE("work: batches of alike rays walk together as far as recorded") {
    if (best_instruction_set() < detail::InstructionSet::sse42) return;  // by one lane each walks alone
    const OpenedBlob landscape = terrain_of(12);
    const detail::BlobData& asset = detail::data_of(landscape.blob);
    std::int32_t longest = 0;
    for (const std::int32_t side : asset.extent) longest = std::max(longest, side);
    // As far apart as rays of a group may be, exactly.
    const float near = std::ldexp(static_cast<float>(longest), asset.step_exponent - 4);
    const ChosenInstructionSet lanes(detail::InstructionSet::sse42);
    platform::Fingerprint work;
    std::uint64_t leaves = 0;
    const auto ask = [&](const std::vector<Ray>& rays, std::size_t count) {
        std::vector<RayHit> hits(rays.size());
        std::vector<YesNo> yes(rays.size());
        for (const bool any : {false, true}) {
            detail::step_counter = {};
            if (any)
                static_cast<void>(occluded(landscape.blob, std::span(rays).first(count), std::span(yes).first(count)));
            else static_cast<void>(raycast(landscape.blob, std::span(rays).first(count), std::span(hits).first(count)));
            const detail::StepCounter counted = detail::step_counter;
            for (const std::uint64_t number : {counted.nodes, counted.leaves, counted.decisions})
                work.add(static_cast<std::uint32_t>(number));
            leaves = counted.leaves;
        }
    };
    const Vec3 low = landscape.blob.bounds().min, high = landscape.blob.bounds().max;
    const Ray first = {{0.5f * (low.x + high.x), 0.5f * (low.y + high.y), high.z + (high.x - low.x)},
                       {0.25f, 0.125f, -1.0f}};
    ask(std::vector<Ray>(15, first), 15);
    const std::uint64_t leaves_alone = leaves;
    ask(std::vector<Ray>(16, first), 16);
    CHECK(leaves < leaves_alone);
    // One of the rays that are compared with the first, along one axis, at the border and beside it.
    for (const std::size_t count : {std::size_t{15}, std::size_t{16}, std::size_t{17}, std::size_t{40}})
        for (const std::size_t other : {std::size_t{4}, std::size_t{5}, std::size_t{10}, std::size_t{15}})
            for (int axis = 0; axis < 3; ++axis)
                for (const float share : {-2.0f, -1.0f, 0.0f, 1.0f, 1.0f + 0x1p-20f, 2.0f})
                    for (const bool turns : {false, true}) {
                        std::vector<Ray> rays(48, first);
                        for (std::size_t i = 0; i < rays.size(); ++i) {
                            rays[i].origin.x += static_cast<float>(i % 16) * near * 0x1p-6f;
                            rays[i].direction.y += static_cast<float>(i % 16) * 0x1p-8f;
                        }
                        Ray& ray = rays[other];
                        ray = first;
                        float* const origin[3] = {&ray.origin.x, &ray.origin.y, &ray.origin.z};
                        float* const direction[3] = {&ray.direction.x, &ray.direction.y, &ray.direction.z};
                        if (turns) *direction[axis] += share * 0.25f;
                        else *origin[axis] += share * near;
                        ask(rays, count);
                    }
    // Some alike, some not, many of each.
    for (const std::size_t count : {std::size_t{64}, std::size_t{600}, std::size_t{1'100}}) {
        platform::Questions questions(landscape.blob);
        std::vector<Ray> rays(count, first);
        for (std::size_t i = 0; i < count; ++i) {
            if (i % 200 > 120) rays[i] = questions.ray(static_cast<std::uint32_t>(i));
            else rays[i].origin.x += static_cast<float>(i % 40) * near * 0x1p-5f;
        }
        ask(rays, count);
    }
    CHECK(work.value() == 8597428973744789044u);
}
#endif

#endif

}  // namespace
}  // namespace espalier::tests::work_test
