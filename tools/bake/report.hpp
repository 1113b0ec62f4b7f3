// The report of a bake: as lines for people, as JSON for scripts.
#pragma once

#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "base/verb_arguments.hpp"
#include "base/exit_code.hpp"
#include "import/base/imported.hpp"
#include "policy.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

/// Where the coordinates come from and what was done to them: unit, axes, skipped elements, for each file.
void say_import(const Console& console, const BakeArguments& arguments, const Imported& imported);
/// What was dropped, with a line for each reason.
void say_findings(const Console& console, const BakeReport& report);
/// What was wrong with the input, what became of it, and the result in numbers.
void say_report(const Console& console, const BakeReport& report);

/// The keys of a bake that describe its input: output, inputs, scale, up.
Json input_json(const BakeArguments& arguments, const Imported& imported);
Json findings_json(const BakeReport& report);
Json bake_json(const BakeArguments& arguments, const Imported& imported, const BakeReport& report, const Blob& blob,
               std::span<const Warning> warnings);

/// Returns where the blob may not be what its user expects. A size that the policy states is expected.
std::vector<Warning> bake_warnings(const BakeReport& report, const BakePolicy& policy, const Imported& imported);

}  // namespace espalier::tools
