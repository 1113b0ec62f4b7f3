// Rows for programs (JSON lines) and for people (a table).
#pragma once

#include "measure.hpp"
#include "options.hpp"

namespace espalier::bench {

/// One JSON object a line for each row; null where a system has no such query and where there is no reference.
void print_json(const MeshResult& result, const Options& options);

void print_table(const MeshResult& result, const Options& options);

}  // namespace espalier::bench
