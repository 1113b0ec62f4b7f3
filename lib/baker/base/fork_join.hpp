// Two parts of a tree at the same time. They write to different places, so the result is independent of scheduling.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <baker/base/threads.hpp>

namespace espalier::baker {

inline constexpr std::uint32_t smallest_parallel = 4096;  // triangles; below this a thread costs more than it brings

/// Calls left(threads) and right(threads), which share `threads` by their sizes: one after the other with one thread
/// or few triangles.
template <class Left, class Right>
void fork_join(unsigned threads, std::uint32_t left_count, std::uint32_t right_count, Left left, Right right) {
    const double count = static_cast<double>(left_count) + static_cast<double>(right_count);
    if (threads <= 1 || count < smallest_parallel) {
        left(1u);
        right(1u);
        return;
    }
    const double share = static_cast<double>(left_count) / count;
    const unsigned left_threads = std::clamp(static_cast<unsigned>(std::lround(share * threads)), 1u, threads - 1);
    Helper helper;
    if (!helper.start([&, left_threads] { left(left_threads); })) left(1u);  // the same work in this one
    right(threads - left_threads);
    helper.wait();
}

}  // namespace espalier::baker
