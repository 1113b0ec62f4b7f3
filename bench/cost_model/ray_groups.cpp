#include "ray_groups.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <span>

#include <espalier/statistics.hpp>

namespace espalier::bench {
namespace {

constexpr std::size_t shares_by_nodes = 16;
constexpr std::size_t shares_by_triangles = 8;

/// The part of a list that belongs to one of several equal shares.
template <class Value>
std::span<Value> share_of(std::span<Value> all, std::size_t number, std::size_t shares) {
    const std::size_t begin = all.size() * number / shares, end = all.size() * (number + 1) / shares;
    return all.subspan(begin, end - begin);
}

RayGroup group_of(const Blob& blob, const std::vector<Ray>& rays, const std::vector<QueryCounters>& work,
                  std::span<const std::uint32_t> members) {
    RayGroup group;
    group.blob = blob;
    for (const std::uint32_t ray : members) {
        group.rays.push_back(rays[ray]);
        group.nodes += static_cast<double>(work[ray].nodes);
        group.leaves += static_cast<double>(work[ray].leaves);
        group.groups += static_cast<double>(work[ray].groups);
        group.triangles += static_cast<double>(work[ray].triangles);
    }
    for (double* sum : {&group.nodes, &group.leaves, &group.groups, &group.triangles})
        *sum /= static_cast<double>(members.size());
    return group;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::vector<RayGroup> group_by_work(const Blob& blob, const std::vector<Ray>& rays) {
    std::vector<QueryCounters> work(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) static_cast<void>(raycast(blob, rays[i], work[i]));
    std::vector<std::uint32_t> order(rays.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto by = [&](auto measure) {
        return [&work, measure](std::uint32_t a, std::uint32_t b) { return measure(work[a]) < measure(work[b]); };
    };
    std::stable_sort(order.begin(), order.end(), by([](const QueryCounters& c) { return c.nodes; }));
    std::vector<RayGroup> groups;
    for (std::size_t i = 0; i < shares_by_nodes; ++i) {
        const auto slice = share_of(std::span(order), i, shares_by_nodes);
        std::stable_sort(slice.begin(), slice.end(), by([](const QueryCounters& c) { return c.triangles; }));
        for (std::size_t j = 0; j < shares_by_triangles; ++j) {
            const auto members = share_of(slice, j, shares_by_triangles);
            if (members.empty()) continue;
            std::sort(members.begin(), members.end());
            groups.push_back(group_of(blob, rays, work, members));
        }
    }
    return groups;
}

void time_groups(std::vector<RayGroup>& groups, unsigned rounds) {
    std::vector<std::vector<double>> ratios(groups.size());
    std::vector<double> medians;
    unsigned found = 0;
    for (unsigned round = 0; round <= rounds; ++round) {
        std::vector<double> times;
        for (const RayGroup& group : groups) {
            const auto start = std::chrono::steady_clock::now();
            for (const Ray& ray : group.rays) found += bool(raycast(group.blob, ray));
            const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
            times.push_back(taken.count() / static_cast<double>(group.rays.size()));
        }
        if (round == 0) continue;  // it only warmed the caches
        medians.push_back(median(times));
        for (std::size_t i = 0; i < groups.size(); ++i) ratios[i].push_back(times[i] / medians.back());
    }
    static std::atomic<unsigned> sink;  // so that no compiler drops the casts
    sink = found;
    const double typical = median(medians);
    for (std::size_t i = 0; i < groups.size(); ++i) groups[i].nanoseconds = typical * median(ratios[i]);
}

}  // namespace espalier::bench
