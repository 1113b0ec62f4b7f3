// The trade as a picture that can be read without the table.
#pragma once

#include <string>
#include <vector>

#include "point.hpp"

namespace espalier::tools {

/// SVG: bytes a triangle against the time of each query, coloured by lattice, with the Pareto front of each lattice as
/// a line, and the front's numbers below. `conditions` describes how it was measured.
std::string trade_chart(const std::string& mesh, const std::string& conditions, const std::vector<TradePoint>& points);

}  // namespace espalier::tools
