#include "point.hpp"

#include <algorithm>

namespace espalier::tools {

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

}  // namespace espalier::tools
