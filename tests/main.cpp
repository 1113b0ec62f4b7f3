// The main function of every program of tests. Environment: ESPALIER_TEST_LEAVE_OUT, patterns of cases that do not run,
// with commas between them.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdlib>

int main(int count, char** arguments) {
    doctest::Context context(count, arguments);
    if (const char* left_out = std::getenv("ESPALIER_TEST_LEAVE_OUT")) context.addFilter("test-case-exclude", left_out);
    return context.run();
}
