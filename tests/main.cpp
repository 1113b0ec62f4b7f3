// The main function of every program of tests. Environment: ESPALIER_SET, the best instruction set that runs;
// ESPALIER_TEST_LEAVE_OUT, patterns of cases that do not run, with commas between them.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "support/machine/chosen_instruction_set.hpp"

int main(int count, char** arguments) {
    if (const std::string wrong = espalier::tests::force_instruction_set(); !wrong.empty()) {
        std::fprintf(stderr, "%s\n", wrong.c_str());
        return 2;
    }
    doctest::Context context(count, arguments);
    if (const char* left_out = std::getenv("ESPALIER_TEST_LEAVE_OUT")) context.addFilter("test-case-exclude", left_out);
    return context.run();
}
