// The mutator of the targets that open a blob. An input is a blob, then bytes that arguments are made of (opening.hpp).
#pragma once

#if defined(ESPALIER_FUZZ)

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <espalier/format.hpp>

#include "opening.hpp"

namespace espalier::fuzz {

/// Changes a word of the header, of a node or of the leaves.
inline void change_a_word(std::span<std::byte> blob, tests::Random& random) {
    namespace header = format::header;
    const std::uint32_t nodes = std::min(get(blob, header::node_count_at), 64u);
    const auto profile = static_cast<Profile>(std::to_integer<std::uint8_t>(blob[header::profile_at]));
    const std::size_t node_bytes = format::node_bytes(profile);
    std::size_t at = 4 * std::size_t{random.below(static_cast<std::uint32_t>(blob.size() / 4))};
    if (random.coin()) {
        const bool is_in_node = random.coin();
        at = 4 * std::size_t{random.below(static_cast<std::uint32_t>((is_in_node ? node_bytes : header::bytes) / 4))};
        if (is_in_node) at += header::bytes + node_bytes * random.below(nodes + 1);
    }
    if (at + 4 > blob.size()) return;
    put(blob, at, changed_word(get(blob, at), random));
}

/// Changes the blob or the arguments, and repairs what the first checks of `open` would stop at.
template <class Repair>
std::size_t mutate_blob(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed, Repair repair) {
    namespace header = format::header;
    tests::Random random(seed);
    const auto bytes_of = [&](std::size_t count) { return std::as_writable_bytes(std::span(data, count)); };
    std::size_t blob_bytes = stated_size(bytes_of(size));
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

}  // namespace espalier::fuzz

#endif
