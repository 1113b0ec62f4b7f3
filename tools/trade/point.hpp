// Many bakes of one source: what is measured of each, side by side and on the same questions, and which is the best by
// bytes, error and counted work, never by a clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/format.hpp>
#include <espalier/import.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/advanced/statistics.hpp>

#include "report/diagnostics.hpp"
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
    CountedWork work = {};    ///< of a closest-hit ray
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

struct SampleQueries {
    /// From a sphere of 1.2 radii around the source towards random points in its box; both the
    /// closest and any hit are queried.
    std::vector<Ray> rays;
    /// Of a fortieth of the box's diagonal, around points up to a twentieth of it beside the surface.
    std::vector<Sphere> spheres;
    /// On the source's surface, evenly by area.
    std::vector<Vec3> surface_points;
};

/// As many of each as `count`, of blobs with that origin; none when the source has no sound triangle with an area.
/// Every machine makes the same queries: the arithmetic rounds alike everywhere, and the generator is our own.
SampleQueries make_sample_queries(const ImportResult& source, const Vec3d& origin, std::size_t count);

/// Every combination is baked.
struct TradeSpace {
    std::vector<unsigned> bits;
    std::vector<unsigned> leaf_sizes;  ///< a profile whose leaves are smaller takes its largest, once
    std::vector<float> byte_prices;
    std::vector<Profile> profiles;
    std::vector<Builder> builders;
    std::size_t rays = 0;
    unsigned repetitions = 0;
};

/// One point for each combination. `options` holds what all have in common. All blobs take turns in short slices, so
/// that a change of the machine's speed hits them alike; times are medians. `done` receives a stage and how much of
/// it is done, 0..1. Throws CommandError as bake_or_throw does, and (invalid_input) when the source has no triangle
/// with an area.
std::vector<TradePoint> measure_trade(const ImportResult& imported, const BakeOptions& options, const TradeSpace& space,
                                      const std::function<void(const char* stage, double done)>& done);

struct PickGoal {
    std::optional<std::uint64_t> max_bytes;
    bool may_coarsen = false;   ///< whether the lattice may lose bits until something fits
    double max_dropped = 10.0;  ///< percent of the triangles: a lattice is not coarsened beyond it
    std::string limit_name;     ///< "--max-bytes 64K", for messages
    /// The choices of the user, which stay; without one, all that are worth a try.
    std::optional<Profile> profile;
    std::optional<Builder> builder;
    std::optional<unsigned> leaf_size;
};

/// "profile fast, builder sweep_sah, leaves of up to 8 triangles, byte price 5, 16 bits"
std::string describe(const TradePoint& candidate);

struct Picked {
    BakeResult baked;
    TradePoint chosen;
    std::vector<TradePoint> tried;  ///< in the order in which they were, without times
};

/// Throws CommandError: as bake_or_throw, and (unsupported) when nothing fits, with the smallest that was reached.
Picked pick(const ImportResult& imported, const BakeOptions& options, const PickGoal& goal);

/// `options` are those that the search started with.
void say_pick(const Console& console, const Picked& picked, const BakeOptions& options);
Json pick_json(const Picked& picked);

}  // namespace espalier::tools
