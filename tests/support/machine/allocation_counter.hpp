// Counts every operator new of the test program, and makes one of them fail.
#pragma once

#include <cstdint>

namespace espalier::tests {

/// Calls of any operator new since the program began, in all threads.
std::uint64_t allocation_count();

/// Blocks that were allocated by them and not freed yet.
std::int64_t live_allocations();

/// As long as it lives, the allocation after the next `before_it` fails, in whatever thread: std::bad_alloc.
class FailingAllocation {
public:
    explicit FailingAllocation(std::uint64_t before_it);
    ~FailingAllocation();
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;
    [[nodiscard]] bool was_reached() const;

private:
    std::uint64_t number_;
};

}  // namespace espalier::tests
