// Counts every operator new of the test program.
#pragma once

#include <cstdint>

namespace espalier::tests {

/// Calls of any operator new since the program began, in all threads.
std::uint64_t allocation_count();

}  // namespace espalier::tests
