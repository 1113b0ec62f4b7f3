#include "parallel_rows.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace espalier::tools {

void for_each_row(unsigned rows, unsigned threads, const std::function<void(unsigned)>& row,
                  const std::function<void(double)>& done) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    threads = std::clamp(threads, 1u, std::max(1u, rows));
    std::atomic<unsigned> next{0};
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threads; ++i) {
        helpers.emplace_back([&] {
            for (unsigned number = next++; number < rows; number = next++) row(number);
        });
    }
    for (unsigned number = next++; number < rows; number = next++) {
        row(number);
        done(static_cast<double>(number) / rows);
    }
}

}  // namespace espalier::tools
