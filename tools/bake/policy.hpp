// What a bake may lose before it is an error, by which a pipeline trusts an exit status, and its report: as lines for
// people, as JSON for scripts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>
#include <espalier/import.hpp>

#include "base/exit_code.hpp"
#include "base/verb_arguments.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

/// What the command demands of a bake.
struct AssetPolicy : BakePolicy {
    struct SizeRange {
        double least = 0.0;  ///< metres
        double most = 0.0;
        std::string words;  ///< as given
    };
    std::optional<SizeRange> expected_size;
};

/// A reason for which triangles are dropped.
struct DropReason {
    Finding Findings::*finding;
    const char* key;    ///< in JSON
    const char* words;  ///< in reports
};
inline constexpr DropReason drop_reasons[] = {
    {&Findings::not_finite, "not_finite", "with a corner that is NaN, infinite or beyond float32"},
    {&Findings::index_out_of_range, "index_out_of_range", "with an index out of range"},
    {&Findings::zero_area, "zero_area", "without area"},
    {&Findings::collapsed, "collapsed", "that the lattice flattened to no area"},
    {&Findings::duplicate, "duplicate", "with the corners of another one"},
};

/// Throws CommandError (usage) for a range of sizes that is none.
AssetPolicy asset_policy(const BakeArguments& arguments);

/// Throws CommandError (invalid_input) when the result is not what the policy allows: too much dropped, empty, of an
/// unexpected size, with warnings under --strict. Called before anything is written.
void enforce(const AssetPolicy& policy, const ImportResult& imported, const BakeReport& report,
             std::span<const Warning> warnings);

/// Throws CommandError (invalid_input) when a file has no triangles: of several files, each contributes some.
void refuse_empty_files(const ImportResult& imported);

/// Throws CommandError (invalid_input) when there are warnings. What the first is about is named.
void refuse_warnings(std::span<const Warning> warnings, const ImportResult& imported);

/// Returns the path of the input, or nothing if there are several.
std::string only_input(const ImportResult& imported);
/// Returns "'body.obj', 'wheel.obj'".
std::string names_of_inputs(const ImportResult& imported);

/// In units of the blob.
struct AssetSize {
    double extent = 0.0;       ///< the largest side of the bounds of all triangles with an area
    double uncertainty = 0.0;  ///< how far `extent` may be off, because the numbers of files are rounded
};

/// Returns the size of all meshes, or of all places if they are kept.
AssetSize asset_size(const ImportResult& imported);

/// Where the coordinates come from and what was done to them: unit, axes, skipped elements, for each file.
void say_import(const Console& console, const BakeArguments& arguments, const ImportResult& imported);
/// What was dropped, with a line for each reason.
void say_findings(const Console& console, const BakeReport& report);
/// What was wrong with the input, what became of it, and the result in numbers.
void say_report(const Console& console, const BakeReport& report);

/// The keys of a bake that describe its input: output, inputs, scale, up.
Json input_json(const BakeArguments& arguments, const ImportResult& imported);
Json findings_json(const BakeReport& report);
Json bake_json(const BakeArguments& arguments, const ImportResult& imported, const BakeReport& report, const Blob& blob,
               std::span<const Warning> warnings);

/// Returns where the blob may not be what its user expects. A size that the policy states is expected.
std::vector<Warning> bake_warnings(const BakeReport& report, const AssetPolicy& policy, const ImportResult& imported);

}  // namespace espalier::tools
