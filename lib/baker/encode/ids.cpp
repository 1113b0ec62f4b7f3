#include <baker/encode/ids.hpp>

#include <algorithm>

#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/encode/id_kinds.hpp>

namespace espalier::baker {

namespace {

using namespace format::ids;

/// The kind that takes fewest bits to `number`.
const IdKind& best_kind(const IdKinds& kinds, std::uint32_t number, const RecentNumbers& recent, std::uint32_t mask) {
    const IdKind* best = kinds.kinds.data();
    for (const IdKind& kind : kinds.kinds) {
        if (kind.prefix + kind.width < best->prefix + best->width && kind.reaches(number, recent, mask)) best = &kind;
    }
    return *best;
}

/// Every row of kind_bits bits has the kind that its low bits are the code of.
void put_kinds(std::vector<std::byte>& blob, const IdKinds& kinds) {
    for (std::uint32_t row = 0; row >> kinds.kind_bits == 0; ++row) {
        const auto is_row_of = [&](const IdKind& kind) { return (row & ((1u << kind.prefix) - 1)) == kind.code; };
        const IdKind& kind = *std::find_if(kinds.kinds.begin(), kinds.kinds.end(), is_row_of);
        put_u32(blob, kind.offset);
        put_u8(blob, kind.width);
        put_u8(blob, kind.prefix);
        put_u8(blob, kind.from);
        put_u8(blob, kind.replaced);
    }
}

}  // namespace

IdSteps put_ids(std::vector<std::byte>& blob, std::span<const std::uint32_t> numbers, unsigned number_bits) {
    const auto mask = static_cast<std::uint32_t>((std::uint64_t{1} << number_bits) - 1);
    const IdKinds kinds = choose_id_kinds(numbers, number_bits);
    put_kinds(blob, kinds);

    std::vector<std::byte> blocks;
    const std::size_t begin = blob.size();
    for (std::size_t first = 0; first < numbers.size(); first += block_triangles) {
        const std::size_t begin_of_block = blob.size();
        std::uint32_t begins_of_runs = 0;
        BitStream stream(blob);
        stream.put(numbers[first], number_bits);
        for_each_run(numbers.subspan(first, std::min<std::size_t>(numbers.size() - first, block_triangles)),
                     [&](unsigned run, std::span<const std::uint32_t> steps) {
                         if (run != 0) {
                             stream.finish();
                             const auto at = static_cast<std::uint32_t>(blob.size() - begin_of_block);
                             begins_of_runs |= at << run_begin_bits * (run - 1);
                         }
                         RecentNumbers recent(numbers[first]);
                         for (const std::uint32_t number : steps) {
                             const IdKind& kind = best_kind(kinds, number, recent, mask);
                             stream.put(kind.code, kind.prefix);
                             stream.put((number - recent[kind.from] - kind.offset) & mask, kind.width);
                             recent.add(number, kind.replaced);
                         }
                     });
        stream.finish();
        put_u32(blocks, static_cast<std::uint32_t>(begin_of_block - begin));
        put_u32(blocks, begins_of_runs);
    }
    const auto bytes = static_cast<std::uint32_t>(blob.size() - begin);
    pad_to(blob, 4);
    blob.insert(blob.end(), blocks.begin(), blocks.end());
    return {kinds.kind_bits, bytes};
}

}  // namespace espalier::baker
