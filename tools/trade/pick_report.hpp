// The report of a pick: the chosen configuration, and what was given up for it.
#pragma once

#include "pick.hpp"
#include "report/console.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

/// `options` are those that the search started with.
void say_pick(const Console& console, const Picked& picked, const BakeOptions& options);
Json pick_json(const Picked& picked);

}  // namespace espalier::tools
