// Any bytes: opened as they are, then with magic, version, size and checksum made to fit, so that the fuzzer reaches
// what lies behind them. Whatever opens is asked everything. Bytes behind the size that the header states are what the
// arguments of the queries are made of.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>

#include <espalier/espalier.hpp>

#include "judge.hpp"
#include "opening.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

namespace header = format::header;

void repair(std::span<std::byte> blob) {
    fuzz::repair_header(blob, format::magic, format::version_major, format::version_minor);
}

void open_and_ask(std::span<const std::byte> bytes, std::span<const std::byte> arguments) {
    const Blob blob = open(bytes);
    if (!blob) {
        if (blob.triangle_count() != 0 || detail::data_of(blob).bytes != nullptr)
            fuzz::fail("open", "refused and not empty");
        return;
    }
    Random random(bytes.size(), arguments);
    fuzz::judge(bytes, blob, random);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::judge_repaired_too(std::as_bytes(std::span(data, size)), open_and_ask, repair);
    return 0;
}

#if defined(ESPALIER_FUZZ)

namespace {

/// Changes a word of the header, of a node or of the leaves.
void change_a_word(std::span<std::byte> blob, Random& random) {
    const std::uint32_t nodes = std::min(fuzz::get(blob, header::node_count_at), 64u);
    const auto profile = static_cast<Profile>(std::to_integer<std::uint8_t>(blob[header::profile_at]));
    const std::size_t node_bytes = format::node_bytes(profile);
    std::size_t at = 4 * std::size_t{random.below(static_cast<std::uint32_t>(blob.size() / 4))};
    if (random.coin()) {
        const bool is_in_node = random.coin();
        at = 4 * std::size_t{random.below(static_cast<std::uint32_t>((is_in_node ? node_bytes : header::bytes) / 4))};
        if (is_in_node) at += header::bytes + node_bytes * random.below(nodes + 1);
    }
    if (at + 4 > blob.size()) return;
    fuzz::put(blob, at, fuzz::changed_word(fuzz::get(blob, at), random));
}

}  // namespace

/// Changes the blob or the arguments, and repairs what the first checks of `open` would stop at.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    Random random(seed);
    const auto bytes_of = [&](std::size_t count) { return std::as_writable_bytes(std::span(data, count)); };
    std::size_t blob_bytes = fuzz::stated_size(bytes_of(size));
    const std::size_t argument_bytes = size - blob_bytes;
    if (size >= header::bytes && random.below(3) == 0) {  // other arguments
        const std::size_t room = std::min<std::size_t>(max_size - blob_bytes, 512);
        const std::size_t changed = LLVMFuzzerMutate(data + blob_bytes, std::min(argument_bytes, room), room);
        repair(bytes_of(blob_bytes));
        return blob_bytes + changed;
    }
    if (size >= header::bytes && random.below(2) == 0) {
        for (std::uint32_t i = 0; i <= random.below(3); ++i) change_a_word(bytes_of(blob_bytes), random);
        repair(bytes_of(blob_bytes));
        return size;
    }
    // What is behind the blob moves along.
    std::uint8_t arguments[512];
    const std::size_t kept = std::min(argument_bytes, sizeof arguments);
    std::memcpy(arguments, data + blob_bytes, kept);
    const std::size_t room = max_size > kept ? max_size - kept : max_size;
    blob_bytes = LLVMFuzzerMutate(data, std::min(blob_bytes, room), room);
    if (blob_bytes < header::bytes || random.below(64) == 0) return blob_bytes;
    repair(bytes_of(blob_bytes));
    const std::size_t moved = std::min(kept, max_size - blob_bytes);
    std::memcpy(data + blob_bytes, arguments, moved);
    return blob_bytes + moved;
}

#endif
