// Lists of a fixed number of places, moved together.
#include <cstddef>
#include <cstring>

#include <espalier/c/status.h>

/// Moves the records of each list to those of the list before. A list has `places` places, of which the first
/// `found[i].count` are filled. Writes where lists begin and their statuses.
extern "C" [[clang::export_name("wasm_pack_lists")]] void wasm_pack_lists(
    std::byte* records, std::size_t record_bytes, std::size_t places, const espalier_filled* found,
    std::size_t* offsets, espalier_query_status* statuses, std::size_t count) {
    offsets[0] = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::memmove(records + offsets[i] * record_bytes, records + i * places * record_bytes,
                     found[i].count * record_bytes);
        offsets[i + 1] = offsets[i] + found[i].count;
        statuses[i] = found[i].status;
    }
}
