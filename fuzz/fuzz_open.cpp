// Any bytes: opened as they are, then with size and checksum made to fit, so that the fuzzer reaches what lies behind
// them. Whatever opens must answer every query safely, and alike on every instruction set, even where its boxes lie.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <span>

#include <espalier/espalier.hpp>

#include "support/checksum.hpp"
#include "support/differences.hpp"
#include "support/exact_buffer.hpp"
#include "support/exercise.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

void require_none(const std::optional<std::string>& difference) {
    if (!difference) return;
    std::fprintf(stderr, "%s\n", difference->c_str());
    std::abort();
}

void open_and_ask(std::span<const std::byte> bytes, std::uint64_t seed) {
    Blob blob;
    if (open(bytes, blob) != Status::ok) {
        if (blob.triangle_count() != 0) std::abort();
        return;
    }
    Random random(seed);
    exercise(blob, random, 8);
    const Vec3 low = blob.bounds_min();
    const Vec3 high = blob.bounds_max();
    const auto somewhere = [&] {
        const auto between = [&](float a, float b) { return a + (b - a) * (random.unit() * 2.0f - 0.5f); };
        const float x = between(low.x, high.x);
        const float y = between(low.y, high.y);
        const float z = between(low.z, high.z);
        return Vec3{x, y, z};
    };
    for (int i = 0; i < 8; ++i) {
        const Vec3 from = somewhere();
        const Vec3 to = somewhere();
        require_none(path_difference(blob, Ray{from, {to.x - from.x, to.y - from.y, to.z - from.z}}));
        require_none(path_difference(blob, Sphere{from, (high.x - low.x) * random.unit()}));
    }
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
