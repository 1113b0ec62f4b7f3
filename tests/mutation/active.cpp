// Which mutant a program is and which lanes it has, and on request which mutants it came by.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <runtime/lanes/select.hpp>

#include "mutants.hpp"

namespace mutation {

int active = -1;
unsigned char reached[MUTANT_COUNT + 1] = {};

namespace {

struct AtTheEnd {
    ~AtTheEnd() {
        const char* path = std::getenv("MUTANTS_REACHED");
        std::FILE* file = path == nullptr ? nullptr : std::fopen(path, "w");
        if (file == nullptr) return;
        for (int number = 0; number < MUTANT_COUNT; ++number)
            if (reached[number] != 0) std::fprintf(file, "%d\n", number);
        std::fclose(file);
    }
};

AtTheEnd at_the_end;

/// Before the tables that the start of the program fills. One lane, unless four are asked for: what is mutated is what
/// all instruction sets have in common, and the program has no other sets.
__attribute__((constructor(101))) void choose() {
    if (const char* number = std::getenv("MUTANT"); number != nullptr) active = std::atoi(number);
#if ESPALIER_X86  // not in small code
    using espalier::detail::InstructionSet;
    const char* lanes = std::getenv("MUTANT_LANES");
    const bool four = lanes != nullptr && std::strcmp(lanes, "4") == 0;
    const InstructionSet set = four ? InstructionSet::sse42 : InstructionSet::scalar;
    espalier::detail::known_instruction_set = static_cast<std::uint8_t>(static_cast<unsigned>(set) + 1u);
#endif
}

}  // namespace

}  // namespace mutation
