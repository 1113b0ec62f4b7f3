// Many bakes of one source, of which the best is kept: by bytes, error and counted work, never by a clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

#include "measure.hpp"
#include "import/base/imported.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

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
Picked pick(const Imported& imported, const BakeOptions& options, const PickGoal& goal);

/// `options` are those that the search started with.
void say_pick(const Console& console, const Picked& picked, const BakeOptions& options);
Json pick_json(const Picked& picked);

}  // namespace espalier::tools
