#include "pairs.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <espalier/scenes/pairs.hpp>

#include "collision_loop.hpp"
#include "judge.hpp"
#include "world.hpp"

namespace espalier::fuzz {

using tests::Random;

namespace {

/// What a filter keeps: pairs whose numbers add up to another rest, or all for 0.
struct Sieve {
    std::uint32_t divisor = 0;
    bool operator()(InstanceId a, InstanceId b) const {
        return divisor == 0 || (a.index + 3 * b.index + 5 * b.in_tile) % divisor != 0;
    }
};

/// A pair of a loop, and whether it must be found: what is rounded or not known leaves some pairs open.
template <class Pair>
struct Possible {
    Pair pair;
    bool is_sure;
};

/// Returns by how much two boxes overlap along the axis where they do least: below 0 if they are apart.
double overlap_of(const Box& a, const Box& b) {
    const auto along = [](float a_low, float a_high, float b_low, float b_high) {
        return std::min(static_cast<double>(a_high) - static_cast<double>(b_low),
                        static_cast<double>(b_high) - static_cast<double>(a_low));
    };
    return std::min({along(a.min.x, a.max.x, b.min.x, b.max.x), along(a.min.y, a.max.y, b.min.y, b.max.y),
                     along(a.min.z, a.max.z, b.min.z, b.max.z)});
}

/// Returns how much larger a box may be than the one of whole steps in the tree: floats hold 2^24 steps exactly.
double rounding_of(const Box& box, int step_exponent) {
    for (const float x : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z})
        if (std::abs(x) > std::ldexp(1.0f, step_exponent + 24)) return std::ldexp(256.0, step_exponent);
    return 0.0;
}

/// Calls `visit(slot, instance, box)` with the live instances in ascending order.
template <class OnInstance>
void for_each_box(Trial& trial, OnInstance visit) {
    for (const auto& [slot, instance] : trial.model().live())
        visit(slot, instance, *box_of(trial.scene(), trial.model().handle_of(slot)));
}

std::vector<Possible<InstancePair>> loop_over_boxes(Trial& trial, bool only_moved, const Sieve& sieve) {
    struct Entry {
        std::uint32_t slot, mask;
        Box box;
    };
    std::vector<Entry> all;
    for_each_box(trial, [&](std::uint32_t slot, const Instance& instance, const Box& box) {
        all.push_back({slot, instance.mask, box});
    });
    const int exponent = trial.scene().step_exponent();
    std::vector<Possible<InstancePair>> pairs;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            const Entry &a = all[i], &b = all[j];
            const double overlap = overlap_of(a.box, b.box);
            const auto moved = [&](bool unknown) {
                return !only_moved || trial.model().has_moved(a.slot, unknown) ||
                       trial.model().has_moved(b.slot, unknown);
            };
            if ((a.mask & b.mask) == 0 || overlap < 0.0 || !moved(true) || !sieve({a.slot}, {b.slot})) continue;
            const double rounding = rounding_of(a.box, exponent) + rounding_of(b.box, exponent);
            pairs.push_back({{a.slot, b.slot}, overlap >= rounding && moved(false)});
        }
    return pairs;
}

std::vector<Possible<BakedPair>> loop_over_boxes_and_baked(Trial& trial, bool only_moved, const Sieve& sieve) {
    std::vector<Possible<BakedPair>> pairs;
    for_each_box(trial, [&](std::uint32_t slot, const Instance& instance, const Box& box) {
        if (only_moved && !trial.model().has_moved(slot, true)) return;
        const bool is_sure = !only_moved || trial.model().has_moved(slot, false);
        const auto add = [&](InstanceId baked) {
            if (sieve({slot}, baked)) pairs.push_back({{slot, baked}, is_sure});
        };
        static_cast<void>(for_each_candidate(world().baked(), box, add, instance.mask));
    });
    return pairs;
}

InstancePair next_to(const InstancePair& pair) { return {pair.a, pair.b + 1}; }
BakedPair next_to(const BakedPair& pair) {
    const auto [index, in_tile] = pair.baked;
    if (in_tile == no_instance.in_tile) return {pair.moving, {index + 1, 0}};
    return {pair.moving, {index, in_tile + 1}};
}

/// The list that pages make, one behind the other, and the pairs that were refused.
template <class Pair>
struct Pages {
    std::vector<Pair> found, refused;
};

/// Reads pages of a size from a pair on. `collect(page, limit, from)` is the query.
template <class Pair, class Collect>
Pages<Pair> read_pages(std::size_t size, std::uint64_t work, Pair from, Collect collect) {
    Pages<Pair> pages;
    std::vector<Pair> page(size);
    for (int turns = 0; turns < 100'000; ++turns) {
        const FilledPairs<Pair> filled = collect(std::span(page), WorkLimit(work), from);
        require(filled.count <= page.size(), "more pairs than there is room for");
        for (const Pair& pair : filled.in(page)) {
            require(pair >= from && (pages.found.empty() || pages.found.back() < pair), "pairs are not ascending");
            pages.found.push_back(pair);
        }
        if (filled.status == QueryStatus::ok) return pages;
        require(filled.next >= from && (filled.count == 0 || filled.next > page[filled.count - 1]),
                "the next page begins with what there was");
        switch (filled.status) {
            case QueryStatus::output_full:
                require(filled.count != 0 || page.empty(), "a page with room has no pair, and there are more");
                if (page.empty()) page.resize(1);
                break;
            case QueryStatus::work_limit:
                require(work != WorkLimit::unlimited().visits(), "work without a limit has reached it");
                if (filled.next == from) work = 2 * work + 1;
                break;
            case QueryStatus::out_of_range:
                pages.refused.push_back(filled.next);
                break;
            default:
                require(false, "a status that no page has");
        }
        from = filled.status == QueryStatus::out_of_range ? next_to(filled.next) : filled.next;
    }
    fail("pairs", "pages without an end");
}

/// Compares what was found from a pair on with a loop. Returns the pairs of the loop that were found.
template <class Pair>
void compare(const std::vector<Pair>& found, const std::vector<Possible<Pair>>& loop, const Pair& from) {
    auto at = found.begin();
    for (const auto& [pair, is_sure] : loop) {
        if (pair < from) continue;
        const bool is_found = at != found.end() && *at == pair;
        require(is_found || !is_sure, "a pair of the loop is not found, or one is found that is not in the loop");
        if (is_found) ++at;
    }
    require(at == found.end(), "a pair is found that is not in the loop");
}

template <class Pair, class Judge>
void compare_colliding(const Pages<Pair>& pages, const std::vector<Pair>& candidates, const Pair& from, Judge judge) {
    std::size_t known = 0;
    for (const Pair& pair : candidates) {
        if (pair < from) continue;
        const Verdict verdict = judge(pair);
        const bool is_found = std::ranges::binary_search(pages.found, pair);
        const bool is_refused = std::ranges::binary_search(pages.refused, pair);
        require(verdict != Verdict::touching || is_found, "a pair that collides is not found");
        require(verdict != Verdict::apart || (!is_found && !is_refused), "a pair that is apart collides or is refused");
        require(verdict != Verdict::refused || is_refused, "a pair whose overlap is refused is not refused");
        known += is_found || is_refused ? 1u : 0u;
    }
    require(known == pages.found.size() + pages.refused.size(), "a pair collides that is no candidate");
}

constexpr std::size_t most_overlaps = 100;  // a loop over more of them takes too long for a fuzzer

/// Draws pages, limits and first pairs, and compares what the two queries return with the loops.
template <class Pair, class Candidates, class Colliding, class Judge>
void check_kind(const std::vector<Possible<Pair>>& loop, Random& random, Candidates collect_candidates,
                Colliding collect_colliding, Judge judge) {
    const auto size = [&] { return random.coin() ? random.below(4) : random.below(200); };
    Pair from;
    if (random.below(4) == 0 && !loop.empty()) from = loop[random.below(static_cast<std::uint32_t>(loop.size()))].pair;
    if (random.below(16) == 0) from = next_to(from);
    const auto candidates = [&](std::size_t room) {
        return read_pages(room, 0, from,
                          [&](std::span<Pair> page, WorkLimit, Pair first) { return collect_candidates(page, first); })
            .found;
    };
    const std::vector<Pair> all = candidates(10'000);
    compare(all, loop, from);
    require(candidates(size()) == all, "pages of another size have other pairs");
    if (all.size() > most_overlaps) return;
    const std::uint64_t limits[] = {random.below(8), random.below(2'000), WorkLimit::unlimited().visits()};
    compare_colliding(read_pages(size(), limits[random.below(3)], from, collect_colliding), all, from, judge);
}

}  // namespace

void check_pairs(Trial& trial, Random& random) {
    MovingScene& scene = trial.scene();
    const Sieve sieve = {random.coin() ? 0 : 1 + random.below(4)};
    PairFilter filter;
    filter.only_moved = random.coin();
    if (sieve.divisor != 0) filter.keep = sieve;
    if (trial.model().must_refit()) {
        std::vector<InstancePair> page(4);
        std::vector<BakedPair> baked_page(4);
        require(
            collect_candidate_pairs(scene, page, filter).status == QueryStatus::not_refitted &&
                collect_colliding_pairs(scene, page, WorkLimit(9), filter).status == QueryStatus::not_refitted &&
                collect_candidate_pairs(scene, world().baked(), baked_page, filter).status == QueryStatus::not_refitted,
            "pairs of a scene that waits for a refit");
        return;
    }
    const auto part_of_slot = [&](std::uint32_t slot) { return part_of(trial.model().live().at(slot)); };
    if (random.below(3) != 0)
        return check_kind<InstancePair>(
            loop_over_boxes(trial, filter.only_moved, sieve), random,
            [&](std::span<InstancePair> page, InstancePair from) {
                return collect_candidate_pairs(scene, page, filter, from);
            },
            [&](std::span<InstancePair> page, WorkLimit limit, InstancePair from) {
                return collect_colliding_pairs(scene, page, limit, filter, from);
            },
            [&](const InstancePair& pair) { return touches(part_of_slot(pair.a), part_of_slot(pair.b)); });
    const BakedScene& baked = world().baked();
    check_kind<BakedPair>(
        loop_over_boxes_and_baked(trial, filter.only_moved, sieve), random,
        [&](std::span<BakedPair> page, BakedPair from) {
            return collect_candidate_pairs(scene, baked, page, filter, from);
        },
        [&](std::span<BakedPair> page, WorkLimit limit, BakedPair from) {
            return collect_colliding_pairs(scene, baked, page, limit, filter, from);
        },
        [&](const BakedPair& pair) {
            PlacedPart part = part_of_slot(pair.moving);
            if (pair.baked.in_tile != no_instance.in_tile)
                part.transform = to_local(instance_at(baked, InstanceId{pair.baked.index})->transform, part.transform);
            const Blob mesh = *mesh_at(baked, pair.baked);
            return touches(part, part_in(baked, pair.baked, mesh));
        });
}

}  // namespace espalier::fuzz
