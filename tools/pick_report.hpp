// What a pick tells: what was taken, and what was given up for it.
#pragma once

#include "console.hpp"
#include "json_output.hpp"
#include "pick.hpp"

namespace espalier::tools {

/// `options` are those that the search started with.
void say_pick(const Console& console, const Picked& picked, const BakeOptions& options);
Json pick_json(const Picked& picked);

}  // namespace espalier::tools
