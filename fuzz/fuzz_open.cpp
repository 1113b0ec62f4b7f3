// Any bytes: opened as they are, then with size and checksum made to fit, so that the fuzzer reaches what lies behind
// them. Whatever opens must answer every query safely.
#include <cstdlib>
#include <span>

#include <espalier/espalier.hpp>

#include "support/checksum.hpp"
#include "support/exact_buffer.hpp"
#include "support/exercise.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

void open_and_ask(std::span<const std::byte> bytes, std::uint64_t seed) {
    Blob blob;
    if (open(bytes, blob) != Status::ok) {
        if (blob.triangle_count() != 0) std::abort();
        return;
    }
    Random random(seed);
    exercise(blob, random, 12);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    // The exact-size copy lies at an address that the input chooses.
    ExactBuffer buffer(bytes, size % 16);
    open_and_ask(buffer.bytes(), size);
    if (size < format::header::bytes) return 0;
    const std::span<std::byte> changed = buffer.bytes();
    const auto put = [&](std::size_t at, std::size_t value) {
        for (unsigned i = 0; i < 4; ++i) changed[at + i] = static_cast<std::byte>(value >> (8 * i));
    };
    put(format::header::magic_at, format::magic);
    put(format::header::version_major_at, format::version_major | std::size_t{format::version_minor} << 16);
    put(format::header::total_bytes_at, size);
    repair_checksum(changed);
    open_and_ask(changed, size + 1);
    return 0;
}
