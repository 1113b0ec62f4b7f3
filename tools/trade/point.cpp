#include "point.hpp"

#include <algorithm>

#include <import/base/numbers.hpp>

#include "base/choices.hpp"

namespace espalier::tools {

namespace {

// Fitted by bench/cost_model to three meshes (docs/trade.md): the triangles of a leaf cost little beside the way to it.
constexpr double leaf_visit = 1.4;
constexpr double triangle_test = 0.045;

/// Returns the cost of a visit, as a multiple of one of the fast profile (docs/trade.md). Of profile tiny a strip is
/// decoded as a whole.
double decoding_factor(Profile profile) {
    constexpr double factors[] = {1.0, 1.11, 1.11, 1.8};
    return factors[static_cast<std::size_t>(profile)];
}

/// Quoted, as RFC 4180 has it: a name may hold commas and quotes.
std::string csv_text(const std::string& value) {
    std::string quoted = "\"";
    for (const char character : printable(value)) quoted += character == '"' ? "\"\"" : std::string(1, character);
    return quoted + '"';
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

BakeOptions TradePoint::applied_to(BakeOptions options) const {
    options.profile = profile;
    options.build.builder = builder;
    options.build.max_leaf_triangles = leaf_size;
    options.build.byte_price = byte_price;
    return options;
}

void TradePoint::take(const BakeReport& report, const CountedWork& counted) {
    bytes = report.bytes;
    triangles = report.tree.triangles;
    depth = report.tree.depth;
    bake_seconds = report.seconds;
    max_error = report.lattice.max_error;
    work = counted;
    cost = decoding_factor(profile) * (work.nodes + leaf_visit * work.leaves + triangle_test * work.triangles);
}

Json trade_json(const std::vector<TradePoint>& points) {
    Json rows = Json::array();
    std::vector<std::vector<bool>> fronts;
    for (const TimedQuery& query : timed_queries) fronts.push_back(pareto_front(points, query));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const TradePoint& point = points[i];
        Json row{{"profile", name_in(profile_choices, point.profile)},
                 {"builder", name_in(builder_choices, point.builder)},
                 {"bits", point.bits},
                 {"leaf_size", point.leaf_size},
                 {"byte_price", json_number(point.byte_price)},
                 {"triangles", point.triangles},
                 {"bytes", point.bytes},
                 {"bytes_per_triangle", point.bytes_per_triangle()},
                 {"max_error", point.max_error},
                 {"mean_error", point.mean_error},
                 {"closest_ns", point.closest_ns},
                 {"any_ns", point.any_ns},
                 {"overlap_ns", point.overlap_ns},
                 {"nodes_per_ray", point.work.nodes},
                 {"leaves_per_ray", point.work.leaves},
                 {"triangles_per_ray", point.work.triangles},
                 {"candidates_per_ray", point.work.candidates},
                 {"counted_cost", point.cost},
                 {"depth", point.depth},
                 {"bake_seconds", point.bake_seconds}};
        for (std::size_t query = 0; query < fronts.size(); ++query) {
            row[text("pareto_", timed_queries[query].name)] = fronts[query][i] ? 1 : 0;
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string trade_csv(const std::string& mesh, const std::vector<TradePoint>& points) {
    std::string lines;
    const Json rows = trade_json(points);
    for (const Json& row : rows.elements()) {
        if (lines.empty()) {
            lines = "mesh";
            for (const auto& [key, value] : row.members()) lines += ',' + key;
            lines += '\n';
        }
        lines += csv_text(mesh);
        for (const auto& [key, value] : row.members()) lines += ',' + value.plain();
        lines += '\n';
    }
    return lines;
}

}  // namespace espalier::tools
