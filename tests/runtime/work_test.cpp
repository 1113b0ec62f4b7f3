// Claims about how much queries look at: an order or a culling that is a little wrong changes no answer. Counted only
// in builds with ESPALIER_COUNT_STEPS, as those with sanitizers and with mutants are.
#include <doctest/doctest.h>

#include <espalier/espalier.hpp>
#include <runtime/simd/select.hpp>
#include <runtime/step_counter.hpp>

#include "../platform/answers.hpp"
#include "../support/baking.hpp"
#include "../support/mesh_makers.hpp"

#if ESPALIER_COUNT_STEPS && !ESPALIER_NEON

using namespace espalier;
using namespace espalier::tests;

namespace {

/// Asks with these lanes and no others. Those that multiply and add at once round the planes of a node otherwise,
/// outward alike, and may look at a node more or less.
class Lanes {
public:
#if ESPALIER_X86
    explicit Lanes(detail::InstructionSet set) {
        detail::known_instruction_set = static_cast<std::uint8_t>(static_cast<unsigned>(set) + 1u);
    }
    ~Lanes() { detail::known_instruction_set = before_; }
#else
    explicit Lanes(detail::InstructionSet) {}
    ~Lanes() = default;
#endif
    Lanes(const Lanes&) = delete;
    Lanes& operator=(const Lanes&) = delete;

private:
#if ESPALIER_X86
    std::uint8_t before_ = detail::known_instruction_set;
#endif
};

struct Work {
    const char* query;
    std::uint64_t nodes, leaves, decisions;
};

template <class Ask>
void check(const Work& expected, Ask ask) {
    detail::step_counter = {};
    ask();
    const detail::StepCounter counted = detail::step_counter;
    CAPTURE(expected.query);
    CHECK(counted.nodes == expected.nodes);
    CHECK(counted.leaves == expected.leaves);
    CHECK(counted.decisions == expected.decisions);
}

using AskSome = void (*)(const Blob&, platform::Questions&, std::uint32_t, platform::Answers&);

void ask_contacts(const Blob& blob, platform::Questions& questions, std::uint32_t count, platform::Answers&) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Placement placement = questions.placement(number, blob);
        TrianglePair pairs[8], first;
        std::size_t found = 0;
        bool touch = false;
        all_contacts(blob, blob, placement, pairs, found);
        collides(blob, blob, placement, touch);
        first_contact(blob, blob, placement, first, touch);
    }
}

struct Group {
    AskSome ask;
    std::uint32_t count;
    Work expected;
};

void check_work(const Blob& blob, detail::InstructionSet set, std::initializer_list<Group> groups) {
    const Lanes lanes(set);
    for (const Group& group : groups) {
        platform::Questions questions(blob);
        platform::Answers answers;
        check(group.expected, [&] { group.ask(blob, questions, group.count, answers); });
    }
}

}  // namespace

TEST_SUITE("work") {
    TEST_CASE("queries of a landscape look at just as many nodes and leaves as they did") {
        const OpenedBlob landscape(make_terrain(24, 7), {.bits = 18, .profile = format::Profile::fast});
        check_work(landscape.blob, detail::InstructionSet::scalar,
                   {{platform::ask_closest_hits, 200, {"closest hits", 959, 766, 2056}},
                    {platform::ask_filtered_hits, 100, {"filtered and any hits", 1078, 781, 1527}},
                    {platform::ask_all_hits, 100, {"all hits", 488, 443, 1180}},
                    {platform::ask_first_hits, 50, {"first hits", 517, 337, 771}},
                    {platform::ask_sweeps, 20, {"sweeps", 573, 776, 474}},
                    {platform::ask_spheres, 100, {"spheres", 580, 437, 1120}},
                    {platform::ask_volumes, 30, {"volumes", 2616, 2092, 1171}},
                    {platform::ask_approximately, 50, {"approximate queries", 641, 654, 3979}},
                    {platform::ask_closest_points, 100, {"closest points", 715, 1167, 8868}},
                    {platform::ask_closest_pairs, 25, {"segments and boxes", 196, 211, 127}},
                    {ask_contacts, 40, {"contacts", 1079, 478, 0}}});
    }

    TEST_CASE("queries of a closed body look at just as many nodes and leaves as they did") {
        const OpenedBlob body(make_torus(32, 16, 3.0, 1.0), {.bits = 12, .profile = format::Profile::balanced});
        check_work(body.blob, detail::InstructionSet::scalar,
                   {{platform::ask_closest_hits, 200, {"closest hits", 691, 749, 1361}},
                    {platform::ask_filtered_hits, 100, {"filtered and any hits", 861, 932, 1191}},
                    {platform::ask_all_hits, 100, {"all hits", 385, 512, 832}},
                    {platform::ask_first_hits, 50, {"first hits", 380, 367, 461}},
                    {platform::ask_sweeps, 20, {"sweeps", 448, 765, 151}},
                    {platform::ask_spheres, 100, {"spheres", 433, 369, 572}},
                    {platform::ask_volumes, 30, {"volumes", 2066, 2393, 631}},
                    {platform::ask_approximately, 50, {"approximate queries", 455, 610, 5202}},
                    {platform::ask_closest_points, 100, {"closest points", 987, 1916, 21013}},
                    {platform::ask_closest_pairs, 25, {"segments and boxes", 139, 219, 70}},
                    {ask_contacts, 40, {"contacts", 510, 235, 0}}});
    }

#if ESPALIER_X86
    TEST_CASE("four lanes leave just as many triangles open as they did") {
        if (detail::detect_instruction_set() < detail::InstructionSet::sse42) return;
        const OpenedBlob landscape(make_terrain(24, 7), {.bits = 18, .profile = format::Profile::fast});
        check_work(landscape.blob, detail::InstructionSet::sse42,
                   {{platform::ask_closest_hits, 200, {"closest hits", 959, 766, 832}},
                    {platform::ask_spheres, 100, {"spheres", 580, 437, 435}},
                    {platform::ask_closest_points, 100, {"closest points", 715, 1167, 7688}}});
        const OpenedBlob body(make_torus(32, 16, 3.0, 1.0), {.bits = 12, .profile = format::Profile::balanced});
        check_work(body.blob, detail::InstructionSet::sse42,
                   {{platform::ask_closest_hits, 200, {"closest hits", 691, 749, 867}},
                    {platform::ask_spheres, 100, {"spheres", 433, 369, 343}},
                    {platform::ask_closest_points, 100, {"closest points", 987, 1916, 18806}}});
    }
#endif
}

#endif
