// Which mutant a program is, and on request which it came by.
#include <cstdio>
#include <cstdlib>

#include "mutants.hpp"

namespace mutation {
namespace {

int chosen() {
    const char* number = std::getenv("MUTANT");
    return number == nullptr ? -1 : std::atoi(number);
}

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

}  // namespace

const int active = chosen();
unsigned char reached[MUTANT_COUNT + 1] = {};

}  // namespace mutation
