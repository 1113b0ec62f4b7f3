// Any bytes: opened as they are, then with magic, version, size and checksum made to fit, so that the fuzzer reaches
// what lies behind them. Whatever opens is asked everything. Bytes behind the size that the header states are what the
// arguments of the queries are made of.
#include <algorithm>
#include <span>

#include <espalier/espalier.hpp>

#include "blob_mutator.hpp"
#include "judge.hpp"
#include "opening.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

namespace header = format::header;

/// Keeps a minor version that readers accept.
void repair(std::span<std::byte> blob) {
    const std::uint32_t minor = fuzz::get(blob, header::version_major_at) >> 16;
    fuzz::repair_header(blob, format::magic, format::version_major,
                        static_cast<std::uint16_t>(std::min<std::uint32_t>(minor, format::version_minor)));
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
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    return fuzz::mutate_blob(data, size, max_size, seed, repair);
}
#endif
