// What a bake tells: as lines for people, as JSON for scripts.
#pragma once

#include <string>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "import/imported.hpp"
#include "json_output.hpp"

namespace espalier::tools {

/// Where the coordinates come from and what was done to them: unit, axes, skipped elements, for each file.
void say_import(const Console& console, const BakeArguments& arguments, const Imported& imported);
/// What was wrong with the input, and what became of it. Warnings are not silenced by quiet.
void say_findings(const Console& console, const BakeReport& report);
/// The result in numbers, and doubts about the asset's size.
void say_result(const Console& console, const BakeReport& report);

Json bake_json(const BakeArguments& arguments, const Imported& imported, const BakeReport& report, const Blob& blob);

}  // namespace espalier::tools
