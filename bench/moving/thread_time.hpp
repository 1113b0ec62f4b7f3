// The processor time of this thread: work beside it counts less than in elapsed time.
#pragma once

#include <ctime>

namespace espalier::bench {

/// Takes up to a microsecond, which parts of a step are too short for.
inline double thread_seconds() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace espalier::bench
