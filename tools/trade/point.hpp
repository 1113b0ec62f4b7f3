// One way to bake a source, and all that is measured of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/format.hpp>
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>

#include "report/json.hpp"

namespace espalier::tools {

/// Work of one closest-hit ray, on average.
struct CountedWork {
    double nodes = 0.0;
    double leaves = 0.0;
    double triangles = 0.0;
    double candidates = 0.0;
};

/// Casts every ray by the scalar path.
CountedWork count_work(const Blob& blob, std::span<const Ray> rays);

struct TradePoint {
    // what was chosen
    Profile profile = Profile::fast;
    Builder builder = Builder::binned_sah;
    unsigned bits = 0;
    unsigned leaf_size = 0;
    float byte_price = 0.0f;
    // what came out
    std::uint64_t bytes = 0;
    std::uint32_t triangles = 0;
    unsigned depth = 0;
    double bake_seconds = 0.0;
    double max_error = 0.0;   ///< the header's bound
    double mean_error = 0.0;  ///< from points of the source's surface, spread evenly by area, to the baked surface
    CountedWork work;         ///< of a closest-hit ray
    /// The cost of that work in visits of a node of the fast profile, by committed constants, which do not depend on
    /// the options of the bake.
    double cost = 0.0;
    // medians, in nanoseconds
    double closest_ns = 0.0;
    double any_ns = 0.0;
    double overlap_ns = 0.0;

    /// Returns the options of a bake with what was chosen, but for the lattice.
    [[nodiscard]] BakeOptions applied_to(BakeOptions options) const;
    /// Takes what came out of the bake.
    void take(const BakeReport& report, const CountedWork& counted);
    [[nodiscard]] double bytes_per_triangle() const {
        return triangles == 0 ? 0.0 : static_cast<double>(bytes) / triangles;
    }
};

/// The queries that are timed, and where a point keeps each one's time.
struct TimedQuery {
    const char* name;
    double TradePoint::*nanoseconds;
};
inline constexpr TimedQuery timed_queries[] = {
    {"closest", &TradePoint::closest_ns}, {"any", &TradePoint::any_ns}, {"overlap", &TradePoint::overlap_ns}};

/// For each point whether it is on the Pareto front of bytes, time of the query, and largest error: no other point is
/// as good in all three and better in one.
std::vector<bool> pareto_front(const std::vector<TradePoint>& points, const TimedQuery& query);

/// One line of names and one for each point.
std::string trade_csv(const std::string& mesh, const std::vector<TradePoint>& points);
/// The same, as a list of objects.
Json trade_json(const std::vector<TradePoint>& points);

/// SVG: bytes a triangle against the time of each query, coloured by lattice, with the Pareto front of each lattice as
/// a line, and the front's numbers below. `conditions` describes how it was measured.
std::string trade_chart(const std::string& mesh, const std::string& conditions, const std::vector<TradePoint>& points);

}  // namespace espalier::tools
