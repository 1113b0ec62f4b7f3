// Any bytes as a deformable blob, opened as in fuzz_open, and a walk of poses. Each result of refit() is that of a
// model in double. A pose that is taken makes a blob that opens, whose triangles the independent decoder finds at their
// positions, and whose bytes depend on that pose alone. A pose that is refused changes nothing. Queries of the parts
// and of the whole blob have the same answers, which are those of the loop.
#include <cstddef>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

#include "blob_mutator.hpp"
#include "judge.hpp"
#include "opening.hpp"
#include "refit/walk.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;
using fuzz::require;

namespace {

void repair(std::span<std::byte> blob) {
    fuzz::repair_header(blob, format::magic, format::version_major, format::version_minor_of_deformable);
}

/// Checks that what cannot be deformed is refused.
void check_refusals(const Blob& blob, std::span<const std::byte> bytes) {
    std::vector<std::byte> memory(bytes.size());
    const std::size_t least = deformable_bytes(blob);
    if (!blob.is_deformable()) {
        const QueryStatus status = create_deformable(blob, memory).status();
        require(least == 0 && status == (blob ? QueryStatus::no_data : QueryStatus::not_open),
                "a blob that is not deformable is not refused");
        return;
    }
    require(least < bytes.size(), "the moving part is not smaller than the blob");
    require(create_deformable(blob, std::span(memory).first(least - 1)).status() == QueryStatus::no_room,
            "memory that is too small is not refused");
}

void open_and_walk(std::span<const std::byte> bytes, std::span<const std::byte> arguments) {
    const Blob blob = open(bytes);
    check_refusals(blob, bytes);
    if (!blob.is_deformable()) return;
    Random random(bytes.size(), arguments);
    fuzz::walk_poses(bytes, random);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::judge_repaired_too(std::as_bytes(std::span(data, size)), open_and_walk, repair);
    return 0;
}

#if defined(ESPALIER_FUZZ)
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    return fuzz::mutate_blob(data, size, max_size, seed, repair);
}
#endif
