// Calls of which is known what they cost, for ../check_meter.sh: what the plugin says of them must be just that.
#include <cstddef>
#include <cstdint>

#include "blob_in_image.hpp"
#include "marks.hpp"

namespace {

volatile std::uint32_t elsewhere;

/// Four instructions a turn.
void turn(std::uint32_t times) {
    asm volatile(
        ".syntax unified\n"
        "1: nop\n"
        "   nop\n"
        "   subs %0, #1\n"
        "   bne 1b"
        : "+l"(times)::"cc");
}

}  // namespace

int main() {
    using espalier::firmware::measure;
    measure(0, [] { turn(1); });
    measure(1, [] { turn(1); });  // twice, for the most of several
    measure(1, [] { turn(1001); });
    measure(2, [] { elsewhere = elsewhere + 1; });
    measure(3, [] {
        volatile std::uint32_t words[100];
        words[0] = 1;
        words[99] = words[0];
    });
    measure(4, [] {
        const volatile std::byte* const blob = firmware_blob;
        static_cast<void>(blob[0]);
        static_cast<void>(blob[8]);
        static_cast<void>(blob[8]);
    });
    measure(5, [] {
        std::uint32_t word = 0;
        asm volatile("ldr %0, [%1]\n ldrh %0, [%1, #2]" : "=&r"(word) : "r"(firmware_blob));
    });
    measure(6, [] { asm volatile("push {r4-r7, lr}\n add sp, #20" ::: "memory"); });
    measure(7, [] {
        volatile std::uint32_t words[100];
        static_cast<void>(words[0]);  // the frame is needed though nothing is written there
    });
    return 0;
}
