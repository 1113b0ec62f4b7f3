// The main function of every program of tests. Environment: ESPALIER_SET, the best instruction set that runs;
// ESPALIER_TEST_LEAVE_OUT, patterns of cases that do not run, with commas between them.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "support/machine/chosen_instruction_set.hpp"

int main(int count, char** arguments) {
#ifdef __GLIBC__
    // Tests make and drop vectors millions of times. By default glibc returns freed memory to the system, and the next
    // vector faults its pages in again: on virtual machines where a fault is slow, more than half of the time.
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest that it takes
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    mallopt(M_TOP_PAD, 16 << 20);
#endif
    if (const std::string wrong = espalier::tests::force_instruction_set(); !wrong.empty()) {
        std::fprintf(stderr, "%s\n", wrong.c_str());
        return 2;
    }
    doctest::Context context(count, arguments);
    if (const char* left_out = std::getenv("ESPALIER_TEST_LEAVE_OUT")) context.addFilter("test-case-exclude", left_out);
    return context.run();
}
