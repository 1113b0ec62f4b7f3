// The processor time of this process: work of others beside it counts less than in elapsed time, and every thread that
// a peer may start counts.
#pragma once

#include <ctime>

namespace espalier::bench {

class ProcessorTime {
public:
    [[nodiscard]] double seconds() const { return now() - start_; }

private:
    static double now() {
        std::timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    double start_ = now();
};

}  // namespace espalier::bench
