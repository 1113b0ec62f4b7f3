// The warnings of one bake: made once, for people and for scripts.
#pragma once

#include <span>
#include <vector>

#include <espalier/bake.hpp>

#include "base/warning.hpp"
#include "policy.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

/// Returns where the blob may not be what its user expects. A size that the policy states is expected.
std::vector<Warning> bake_warnings(const BakeReport& report, const BakePolicy& policy, const Imported& imported);

/// Prints warnings and adds them to the list.
void give(std::span<const Warning> found, std::vector<Warning>& warnings);

/// An object with kind, message, file, mesh and triangle; what is unknown is null. Errors have the same keys.
Json diagnostic_json(const Warning& warning);
Json warnings_json(std::span<const Warning> warnings);

}  // namespace espalier::tools
