// The warnings of one bake.
#pragma once

#include <vector>

#include <espalier/bake.hpp>

#include "base/warning.hpp"
#include "policy.hpp"

namespace espalier::tools {

/// Returns where the blob may not be what its user expects. A size that the policy states is expected.
std::vector<Warning> bake_warnings(const BakeReport& report, const BakePolicy& policy, const Imported& imported);

}  // namespace espalier::tools
