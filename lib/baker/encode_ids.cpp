#include "encode_ids.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include <espalier/format.hpp>

#include "byte_writer.hpp"

namespace espalier::baker {

namespace {

using namespace format::ids;

/// Takes a step to any number from `offset` after the last one on, as far as its field reaches.
struct StepKind {
    std::uint32_t offset = 0;
    unsigned width = 0;

    [[nodiscard]] bool fits(std::uint32_t step, std::uint32_t mask) const {
        return std::uint64_t{(step - offset) & mask} >> width == 0;
    }
};

struct CountedStep {
    std::uint32_t step = 0;
    std::uint32_t count = 0;
};

/// Steps modulo 2^number_bits; those to the first triangle of a block are not taken.
std::vector<std::uint32_t> steps_between(std::span<const std::uint32_t> numbers, std::uint32_t mask) {
    std::vector<std::uint32_t> steps;
    steps.reserve(numbers.size());
    for (std::size_t i = 1; i < numbers.size(); ++i) {
        if (i % block_triangles != 0) steps.push_back((numbers[i] - numbers[i - 1]) & mask);
    }
    return steps;
}

/// How often each step is among the steps, of large meshes among an even sample of them; ascending.
std::vector<CountedStep> histogram(std::span<const std::uint32_t> steps) {
    constexpr std::size_t sampled = 1u << 14;
    const std::size_t stride = steps.size() / sampled + 1;
    std::vector<std::uint32_t> sorted;
    for (std::size_t i = 0; i < steps.size(); i += stride) sorted.push_back(steps[i]);
    std::sort(sorted.begin(), sorted.end());
    std::vector<CountedStep> counted;
    for (const std::uint32_t step : sorted) {
        if (counted.empty() || counted.back().step != step) counted.push_back({step, 0});
        ++counted.back().count;
    }
    return counted;
}

/// The most frequent steps alone, and fields of every width that reach to both sides, forward and backward.
std::vector<StepKind> candidates(std::vector<CountedStep> counted, unsigned number_bits, std::uint32_t mask) {
    constexpr std::size_t most_frequent = 32;
    std::vector<StepKind> kinds;
    std::sort(counted.begin(), counted.end(), [](const CountedStep& a, const CountedStep& b) {
        return a.count != b.count ? a.count > b.count : a.step < b.step;
    });
    for (std::size_t i = 0; i < std::min(counted.size(), most_frequent); ++i) kinds.push_back({counted[i].step, 0});
    for (unsigned width = 1; width < number_bits; ++width) {
        const std::uint32_t reach = std::uint32_t{1} << width;
        kinds.push_back({(0 - reach / 2) & mask, width});
        kinds.push_back({1 & mask, width});
        kinds.push_back({(0 - reach) & mask, width});
    }
    return kinds;
}

/// 1, 2, 4, 8 or 16 kinds, whichever take fewest bits with the table that holds them. The first takes any step; each
/// of the others is the one that saves most beside those before it.
std::vector<StepKind> choose_kinds(std::span<const std::uint32_t> steps, unsigned number_bits, std::uint32_t mask) {
    const std::vector<CountedStep> counted = histogram(steps);
    const std::vector<StepKind> choice = candidates(counted, number_bits, mask);
    std::uint64_t sample = 0;
    for (const CountedStep& each : counted) sample += each.count;
    std::vector<StepKind> kinds = {{0, number_bits}};
    std::vector<unsigned> widths(counted.size(), number_bits);  // of the best kind so far
    std::vector<StepKind> best = kinds;
    std::uint64_t least_bits = std::numeric_limits<std::uint64_t>::max();
    for (unsigned kind_bits = 0; kind_bits <= max_kind_bits; ++kind_bits) {
        while (kinds.size() < std::size_t{1} << kind_bits) {
            StepKind next = kinds[0];
            std::uint64_t most_saved = 0;
            for (const StepKind& kind : choice) {
                std::uint64_t saved = 0;
                for (std::size_t i = 0; i < counted.size(); ++i) {
                    if (kind.width < widths[i] && kind.fits(counted[i].step, mask))
                        saved += std::uint64_t{counted[i].count} * (widths[i] - kind.width);
                }
                if (saved > most_saved) {
                    most_saved = saved;
                    next = kind;
                }
            }
            kinds.push_back(next);
            for (std::size_t i = 0; i < counted.size(); ++i) {
                if (next.fits(counted[i].step, mask)) widths[i] = std::min(widths[i], next.width);
            }
        }
        std::uint64_t field_bits = 0;
        for (std::size_t i = 0; i < counted.size(); ++i) field_bits += std::uint64_t{counted[i].count} * widths[i];
        // Of the sample; the table's share grows with what is left out of it.
        const std::uint64_t scale = sample == 0 ? 0 : steps.size() / sample;
        const std::uint64_t bits = (field_bits + sample * kind_bits) * scale + 8 * kind_bytes * kinds.size();
        if (bits < least_bits) {
            least_bits = bits;
            best = kinds;
        }
    }
    return best;
}

}  // namespace

IdSteps put_ids(std::vector<std::byte>& blob, std::span<const std::uint32_t> numbers, unsigned number_bits) {
    const auto mask = static_cast<std::uint32_t>((std::uint64_t{1} << number_bits) - 1);
    const std::vector<std::uint32_t> all_steps = steps_between(numbers, mask);
    const std::vector<StepKind> kinds = choose_kinds(all_steps, number_bits, mask);
    const auto kind_bits = static_cast<unsigned>(std::bit_width(kinds.size()) - 1);

    std::vector<std::byte> blocks;
    std::vector<std::byte> steps;
    for (std::size_t first = 0; first < numbers.size(); first += block_triangles) {
        put_u32(blocks, numbers[first]);
        put_u32(blocks, static_cast<std::uint32_t>(steps.size()));
        BitStream stream(steps);
        const std::size_t end = std::min(numbers.size(), first + block_triangles);
        for (std::size_t i = first + 1; i < end; ++i) {
            const std::uint32_t step = (numbers[i] - numbers[i - 1]) & mask;
            std::size_t chosen = 0;
            for (std::size_t kind = 1; kind < kinds.size(); ++kind) {
                if (kinds[kind].width < kinds[chosen].width && kinds[kind].fits(step, mask)) chosen = kind;
            }
            stream.put(static_cast<std::uint32_t>(chosen), kind_bits);
            stream.put((step - kinds[chosen].offset) & mask, kinds[chosen].width);
        }
        stream.finish();
    }
    for (const StepKind& kind : kinds) {
        put_u32(blob, kind.offset);
        put_u32(blob, kind.width);
    }
    blob.insert(blob.end(), blocks.begin(), blocks.end());
    blob.insert(blob.end(), steps.begin(), steps.end());
    pad_to(blob, 4);
    return {kind_bits, static_cast<std::uint32_t>(steps.size())};
}

}  // namespace espalier::baker
