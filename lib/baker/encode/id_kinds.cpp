#include <baker/encode/id_kinds.hpp>

#include <bit>
#include <limits>

namespace espalier::baker {

namespace {

using namespace format::ids;

constexpr unsigned last_place = recent_numbers - 1;
constexpr unsigned unit = 16;  ///< costs are counted in sixteenths of a bit

/// A kind while kinds are chosen.
struct Candidate {
    IdKind kind;
    std::uint32_t cost = 0;  ///< of its code
    std::uint64_t uses = 0;
    std::uint64_t loss = 0;  ///< what the steps that use it would cost more without it

    [[nodiscard]] std::uint32_t step_cost() const { return cost + unit * kind.width; }
};

/// unit * log2(value), the fraction by a straight line between powers of two.
std::uint32_t logarithm(std::uint64_t value) {
    const auto whole = static_cast<unsigned>(std::bit_width(value)) - 1;
    return unit * whole + static_cast<std::uint32_t>((value << 4 >> whole) & (unit - 1));
}

/// An even sample of the blocks.
std::vector<std::span<const std::uint32_t>> sample_of(std::span<const std::uint32_t> numbers) {
    constexpr std::size_t sampled = 1u << 15;
    const std::size_t stride = block_triangles * (numbers.size() / sampled + 1);
    std::vector<std::span<const std::uint32_t>> blocks;
    for (std::size_t first = 0; first < numbers.size(); first += stride)
        blocks.push_back(numbers.subspan(first, std::min<std::size_t>(block_triangles, numbers.size() - first)));
    return blocks;
}

/// Steps from one number to the next, the most frequent first.
std::vector<std::uint32_t> frequent_steps(std::span<const std::span<const std::uint32_t>> blocks, std::uint32_t mask) {
    std::vector<std::uint32_t> sorted;
    for (const auto block : blocks)
        for (std::size_t i = 1; i < block.size(); ++i) sorted.push_back((block[i] - block[i - 1]) & mask);
    std::sort(sorted.begin(), sorted.end());
    struct Counted {
        std::uint32_t step;
        std::size_t count;
    };
    std::vector<Counted> counted;
    for (const std::uint32_t step : sorted) {
        if (counted.empty() || counted.back().step != step) counted.push_back({step, 0});
        ++counted.back().count;
    }
    std::stable_sort(counted.begin(), counted.end(),
                     [](const Counted& a, const Counted& b) { return a.count > b.count; });
    std::vector<std::uint32_t> steps;
    steps.reserve(counted.size());
    for (const Counted& each : counted) steps.push_back(each.step);
    return steps;
}

/// The kind for every step; frequent steps alone; and fields of every width that reach forward, backward and to both
/// sides: narrow ones on along each recent row, wide ones from the newest number to a new row.
std::vector<Candidate> candidates(std::span<const std::uint32_t> frequent, unsigned number_bits, std::uint32_t mask) {
    constexpr std::size_t most_frequent = 16;
    constexpr unsigned widest_in_row = 7, narrowest_to_row = 5;
    std::vector<Candidate> all;
    const auto add = [&](std::uint32_t offset, unsigned width, unsigned from, unsigned replaced) {
        const std::uint32_t cost = 5 * unit + from * unit / 2 + (replaced == last_place ? 2 * unit : 0);
        all.push_back({{offset & mask, width, from, replaced}, cost});
    };
    add(0, number_bits, 0, last_place);
    for (unsigned from = 0; from < recent_numbers; ++from) {
        for (std::size_t i = 0; i < std::min(frequent.size(), from < 2 ? most_frequent : most_frequent / 2); ++i)
            add(frequent[i], 0, from, from);
        // mutant(< -> <=) sanitizer: shifts by the width of the type, where numbers have 32 bits
        for (unsigned width = 1; width < number_bits; ++width) {
            const std::uint32_t reach = std::uint32_t{1} << width;
            for (const std::uint32_t offset : {0 - reach / 2, std::uint32_t{1}, 0 - reach}) {
                if (width <= widest_in_row) add(offset, width, from, from);
                if (width >= narrowest_to_row && from == 0) add(offset, width, from, last_place);
            }
        }
    }
    return all;
}

/// Takes every step by the kind that costs least, and counts uses and losses.
void count(std::span<const std::span<const std::uint32_t>> blocks, std::vector<Candidate>& all, std::uint32_t mask) {
    std::vector<Candidate*> by_cost;
    for (Candidate& each : all) {
        each.uses = each.loss = 0;
        by_cost.push_back(&each);
    }
    std::stable_sort(by_cost.begin(), by_cost.end(),
                     [](const Candidate* a, const Candidate* b) { return a->step_cost() < b->step_cost(); });
    for (const auto block : blocks) {
        for_each_run(block, [&](unsigned, std::span<const std::uint32_t> run) {
            RecentNumbers recent(block[0]);
            for (const std::uint32_t number : run) {
                const auto reaches = [&](const Candidate* each) { return each->kind.reaches(number, recent, mask); };
                const auto best = std::find_if(by_cost.begin(), by_cost.end(), reaches);
                const auto second = std::find_if(best + 1, by_cost.end(), reaches);
                ++(*best)->uses;
                if (second != by_cost.end()) (*best)->loss += (*second)->step_cost() - (*best)->step_cost();
                recent.add(number, (*best)->kind.replaced);
            }
        });
    }
}

/// A code by its frequency costs the logarithm of all steps / its own.
void estimate_costs(std::vector<Candidate>& all) {
    std::uint64_t steps = 1;
    for (const Candidate& each : all) steps += each.uses;
    for (Candidate& each : all)
        each.cost = logarithm(unit * steps) - logarithm(std::min(unit * each.uses + 4, unit * steps));
}

/// Drops as many as that whose absence costs least, never the first.
void drop(std::vector<Candidate>& all, std::size_t count) {
    std::vector<std::size_t> order;
    for (std::size_t i = 1; i < all.size(); ++i) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return all[a].loss < all[b].loss; });
    order.resize(count);
    std::sort(order.begin(), order.end());
    for (std::size_t i = count; i > 0; --i) all.erase(all.begin() + static_cast<std::ptrdiff_t>(order[i - 1]));
}

/// Gives each kind the length of its code. All begin as long as codes may be; while rows of kind_bits bits are left
/// over, the code is shortened that saves most for each row that it then takes.
void set_prefixes(std::vector<Candidate>& all, unsigned kind_bits) {
    std::size_t left = (std::size_t{1} << kind_bits) - all.size();
    for (Candidate& each : all) each.kind.prefix = kind_bits;
    while (left != 0) {
        Candidate* best = nullptr;
        const auto rows = [&](const Candidate& each) { return std::size_t{1} << (kind_bits - each.kind.prefix); };
        for (Candidate& each : all) {
            // mutant(without 2) equivalent: a kind without a prefix has all rows, which are more than are left
            if (rows(each) > left || each.kind.prefix == 0) continue;
            if (best == nullptr || (each.uses + 1) * rows(*best) > (best->uses + 1) * rows(each)) best = &each;
        }
        left -= rows(*best);
        --best->kind.prefix;
    }
}

/// Codes of these lengths, the shortest first. Their bits run against the order of rows, so that the first bit that is
/// read decides most.
void set_codes(std::vector<IdKind>& kinds, unsigned kind_bits) {
    std::uint32_t row = 0;
    for (unsigned prefix = 0; prefix <= kind_bits; ++prefix) {
        for (IdKind& kind : kinds) {
            if (kind.prefix != prefix) continue;
            kind.code = 0;
            // mutant(< -> <=) sanitizer: adds a bit that is 0; the longest codes shift by -1
            for (unsigned bit = 0; bit < prefix; ++bit) kind.code |= (row >> (kind_bits - 1 - bit) & 1u) << bit;
            row += std::uint32_t{1} << (kind_bits - prefix);
        }
    }
}

}  // namespace

IdKinds choose_id_kinds(std::span<const std::uint32_t> numbers, unsigned number_bits) {
    constexpr std::size_t most_kinds = std::size_t{1} << max_kind_bits;
    const auto mask = static_cast<std::uint32_t>((std::uint64_t{1} << number_bits) - 1);
    const auto blocks = sample_of(numbers);
    std::size_t sampled = 1;
    for (const auto block : blocks) sampled += block.size();
    std::vector<Candidate> all = candidates(frequent_steps(blocks, mask), number_bits, mask);
    IdKinds best;
    std::uint64_t least_bits = std::numeric_limits<std::uint64_t>::max();
    for (;;) {
        count(blocks, all, mask);
        estimate_costs(all);
        const auto fewest_bits = static_cast<unsigned>(std::bit_width(all.size() - 1));
        for (unsigned kind_bits = fewest_bits; kind_bits <= max_kind_bits; ++kind_bits) {
            set_prefixes(all, kind_bits);
            std::uint64_t bits = 0;
            for (const Candidate& each : all) bits += each.uses * (each.kind.prefix + each.kind.width);
            bits = bits * (numbers.size() / sampled + 1) + (8 * kind_bytes << kind_bits);
            if (bits >= least_bits) continue;
            least_bits = bits;
            best.kind_bits = kind_bits;
            best.kinds.clear();
            for (const Candidate& each : all) best.kinds.push_back(each.kind);
        }
        if (all.size() == 1) break;
        // mutant(- -> + 2, - -> right side dropped 2) equivalent: of two or more, a tenth and one are at most all but
        // one
        drop(all, std::min(all.size() / 10 + 1, all.size() > most_kinds ? all.size() - most_kinds : all.size() - 1));
    }
    set_codes(best.kinds, best.kind_bits);
    return best;
}

}  // namespace espalier::baker
