#include "warnings.hpp"

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

constexpr double largest_expected_extent = 1000.0;  // metres
constexpr double smallest_expected_extent = 0.001;

const char* name_of_kind(BakeWarning::Kind kind) {
    switch (kind) {
        case BakeWarning::Kind::step_below_float_spacing:
            return "step_below_float_spacing";
        case BakeWarning::Kind::lost_closed:
            return "lost_closed";
        case BakeWarning::Kind::rays_rounded_coarsely:
            return "rays_rounded_coarsely";
    }
    return "";
}

}  // namespace

std::vector<Warning> bake_warnings(const BakeReport& report, const BakePolicy& policy, const Imported& imported) {
    std::vector<Warning> warnings;
    const std::string file = only_input(imported);
    const auto add = [&](const char* kind, const std::string& message) {
        warnings.push_back({kind, message, file, {}, {}});
    };
    for (const BakeWarning& warning : report.warnings) add(name_of_kind(warning.kind), warning.message);
    if (report.tree.triangles == 0 || policy.expected_size) return warnings;
    const double extent = report.bounds.extent;
    if (extent > largest_expected_extent || extent < smallest_expected_extent) {
        add("unexpected_size",
            text(names_of_inputs(imported), ": the asset is ", rounded(extent),
                 " m across. If that is not what it is, give the unit of its file with --unit, or --scale."));
    }
    return warnings;
}

}  // namespace espalier::tools
