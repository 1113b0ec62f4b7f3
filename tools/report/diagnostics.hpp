// Warnings and errors, for people and for scripts.
#pragma once

#include <span>
#include <vector>

#include "base/warning.hpp"
#include "json_output.hpp"

namespace espalier::tools {

/// Prints warnings and adds them to the list.
void give(std::span<const Warning> found, std::vector<Warning>& warnings);

/// Returns an object with kind, message, file, mesh and triangle; what is unknown is null. Errors have the same keys.
Json diagnostic_json(const Warning& warning);
Json warnings_json(std::span<const Warning> warnings);

}  // namespace espalier::tools
