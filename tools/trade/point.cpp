#include "point.hpp"

#include <algorithm>

namespace espalier::tools {

namespace {

// Fitted by bench/cost_model to three meshes (docs/trade.md): the triangles of a leaf cost little beside the way to it.
constexpr double leaf_visit = 1.4;
constexpr double triangle_test = 0.045;

/// Returns the cost of a visit, as a multiple of one of the fast profile (docs/trade.md).
double decoding_factor(Profile profile) {
    switch (profile) {
        case Profile::fast:
            return 1.0;
        case Profile::balanced:
        case Profile::small:
            return 1.11;
        case Profile::tiny:  // of which a strip is decoded as a whole
            return 1.8;
    }
    return 1.0;
}

}  // namespace

std::vector<bool> pareto_front(const std::vector<TradePoint>& points, const TimedQuery& query) {
    const auto time = [&](const TradePoint& point) { return point.*query.nanoseconds; };
    const auto dominates = [&](const TradePoint& a, const TradePoint& b) {
        if (a.bytes > b.bytes || time(a) > time(b) || a.max_error > b.max_error) return false;
        return a.bytes < b.bytes || time(a) < time(b) || a.max_error < b.max_error;
    };
    std::vector<bool> front;
    front.reserve(points.size());
    for (const TradePoint& point : points) {
        front.push_back(std::none_of(points.begin(), points.end(),
                                     [&](const TradePoint& other) { return dominates(other, point); }));
    }
    return front;
}

CountedWork count_work(const Blob& blob, std::span<const Ray> rays) {
    QueryCounters counters;
    for (const Ray& ray : rays) static_cast<void>(raycast(blob, ray, counters));
    if (rays.empty()) return {};
    const auto mean = [&](std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(rays.size()); };
    return {mean(counters.nodes), mean(counters.leaves), mean(counters.triangles), mean(counters.candidates)};
}

double counted_cost(const CountedWork& work, Profile profile) {
    return decoding_factor(profile) * (work.nodes + leaf_visit * work.leaves + triangle_test * work.triangles);
}

}  // namespace espalier::tools
