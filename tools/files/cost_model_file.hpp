// A cost model as a file: {"node_visit": 1, "leaf_visit": 0.7, "triangle": 0, "byte_price": 5}.
#pragma once

#include <string>

#include <espalier/bake.hpp>

namespace espalier::tools {

/// What the file leaves out keeps its default. Throws CommandError: (file_access) when it cannot be read,
/// (invalid_input) that names file and field when it is no JSON object of these fields, each from 0 to a million.
CostModel read_cost_model(const std::string& path);

}  // namespace espalier::tools
