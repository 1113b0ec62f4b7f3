// Why a query was refused, in words for people: which argument, its value, and what would be accepted.
#pragma once

#include <string>

#include "base/verb_arguments.hpp"
#include "kinds.hpp"

namespace espalier::tools {

/// Returns the reason of a query that was answered in part or not at all, without a full stop: which argument is out
/// of its range, or the description of the status.
std::string reason_of(const QueryKind& kind, const QueryArguments& arguments, QueryStatus status);

}  // namespace espalier::tools
