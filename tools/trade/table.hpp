// The trade as numbers: CSV for spreadsheets, JSON for scripts.
#pragma once

#include <string>
#include <vector>

#include "point.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

/// One line of names and one for each point.
std::string trade_csv(const std::string& mesh, const std::vector<TradePoint>& points);
/// The same, as a list of objects.
Json trade_json(const std::vector<TradePoint>& points);

}  // namespace espalier::tools
