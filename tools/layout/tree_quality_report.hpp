// The quality of a tree as tables for people and as JSON.
#pragma once

#include "layout/tree_quality.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

[[nodiscard]] Json tree_quality_json(const TreeQuality& quality);
/// Prints three tables: of levels, of balance and of leaves.
void print_tree_quality(const TreeQuality& quality);

}  // namespace espalier::tools
