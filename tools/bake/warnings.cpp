#include "warnings.hpp"

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

constexpr double largest_expected_extent = 1000.0;  // metres
constexpr double smallest_expected_extent = 0.001;

/// Why the baked surface is not closed, though the source is, and what keeps it closed.
std::string lost_closed_text(const BakeReport& report) {
    std::string dropped, advice;
    const auto add = [&](const Finding& finding, const char* what, const char* remedy) {
        if (finding.count == 0) return;
        dropped += text(dropped.empty() ? "" : " and ", counted(finding.count, "triangle"), ' ', what,
                        " (first: ", finding.first, ")");
        advice += text(advice.empty() ? ": " : "; ", remedy);
    };
    if (report.triangles != 0) {
        add(report.duplicate, "with the corners of another one", "bake parts that share triangles into separate blobs");
        add(report.zero_area, "without area",
            "split the long edge beside a triangle without area, and remove that one");
    }
    const std::string reason = dropped.empty() ? "no triangle is left" : "it lacks " + dropped;
    if (advice.empty()) advice = ": it is too thin for its length";
    const std::string keeping = report.bits_that_keep_closed == 0
                                    ? "No number of bits keeps it closed" + advice
                                    : text("--bits ", report.bits_that_keep_closed, " keeps it closed");
    return text("the source is closed, but at ", counted(report.bits, "bit"), " the baked surface is not, because ",
                reason, ": inside and signed-distance queries will refuse it. ", keeping, ".");
}

}  // namespace

std::vector<Warning> bake_warnings(const BakeReport& report, const BakePolicy& policy, const Imported& imported) {
    std::vector<Warning> warnings;
    const auto of_bake = [file = only_input(imported)](const char* kind, const std::string& message) {
        return Warning{kind, message, file, {}, {}};
    };
    if (report.step_below_float_spacing) {
        warnings.push_back(of_bake(
            "step_below_float_spacing",
            text("the lattice step ", rounded(report.step),
                 " is finer than the spacing of the source's own floats at its coordinates: fewer bits or a "
                 "coarser tolerance loses nothing, and moving the asset closer to the origin gains accuracy.")));
    }
    if (report.lost_closed) warnings.push_back(of_bake("lost_closed", lost_closed_text(report)));
    if (report.triangles == 0) return warnings;
    if (report.rays_rounded_coarsely) {
        warnings.push_back(
            of_bake("rays_rounded_coarsely",
                    text("at ", counted(report.bits, "bit"),
                         " rays that start outside of the asset are rounded to whole lattice steps, coarser than "
                         "float32: one that is aimed exactly at a corner may miss it. 22 bits or fewer leave room for "
                         "a finer grid.")));
    }
    if (policy.expected_size) return warnings;
    if (report.extent > largest_expected_extent || report.extent < smallest_expected_extent) {
        warnings.push_back(
            of_bake("unexpected_size",
                    text(names_of_inputs(imported), ": the asset is ", rounded(report.extent),
                         " m across. If that is not what it is, give the unit of its file with --unit, or --scale.")));
    }
    return warnings;
}

}  // namespace espalier::tools
