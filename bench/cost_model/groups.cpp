#include "groups.hpp"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <numeric>

namespace espalier::bench {
namespace {

constexpr std::size_t shares_by_first = 16;
constexpr std::size_t shares_by_second = 8;

/// The part of a list that belongs to one of several equal shares.
template <class Value>
std::span<Value> share_of(std::span<Value> all, std::size_t number, std::size_t shares) {
    const std::size_t begin = all.size() * number / shares, end = all.size() * (number + 1) / shares;
    return all.subspan(begin, end - begin);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Returns the processor time of this process, which has one thread: what others do beside it counts less.
double processor_nanoseconds() {
#if defined(CLOCK_PROCESS_CPUTIME_ID)
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
#else
    return 1e9 / CLOCKS_PER_SEC * static_cast<double>(std::clock());
#endif
}

}  // namespace

std::vector<Members> group_by_work(std::span<const std::uint64_t> first, std::span<const std::uint64_t> second) {
    Members order(first.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto by = [](std::span<const std::uint64_t> counts) {
        return [counts](std::uint32_t a, std::uint32_t b) { return counts[a] < counts[b]; };
    };
    std::stable_sort(order.begin(), order.end(), by(first));
    std::vector<Members> groups;
    for (std::size_t i = 0; i < shares_by_first; ++i) {
        const auto slice = share_of(std::span(order), i, shares_by_first);
        std::stable_sort(slice.begin(), slice.end(), by(second));
        for (std::size_t j = 0; j < shares_by_second; ++j) {
            const auto members = share_of(slice, j, shares_by_second);
            if (members.empty()) continue;
            std::sort(members.begin(), members.end());
            groups.emplace_back(members.begin(), members.end());
        }
    }
    return groups;
}

std::vector<double> time_in_turns(std::span<const std::size_t> calls, unsigned rounds, bool is_warm,
                                  const std::function<unsigned(std::size_t group)>& run) {
    std::vector<std::vector<double>> ratios(calls.size());
    std::vector<double> medians;
    unsigned found = 0;
    for (unsigned round = 0; round <= rounds; ++round) {
        std::vector<double> times;
        for (std::size_t group = 0; group < calls.size(); ++group) {
            if (is_warm) found += run(group);
            const double start = processor_nanoseconds();
            found += run(group);
            times.push_back((processor_nanoseconds() - start) / static_cast<double>(calls[group]));
        }
        if (round == 0) continue;  // it only warmed the caches
        medians.push_back(median(times));
        for (std::size_t i = 0; i < calls.size(); ++i) ratios[i].push_back(times[i] / medians.back());
    }
    static std::atomic<unsigned> sink;  // so that no compiler drops the calls
    sink = found;
    const double typical = median(medians);
    std::vector<double> nanoseconds;
    for (const std::vector<double>& of_group : ratios) nanoseconds.push_back(typical * median(of_group));
    return nanoseconds;
}

}  // namespace espalier::bench
