#include "total.hpp"

#include <algorithm>
#include <limits>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

void add_finding(Finding& sum, const Finding& finding, std::uint64_t times) {
    if (finding.count == 0) return;
    if (sum.count == 0) sum = {0, finding.first, finding.place};
    sum.count += finding.count * times;
}

}  // namespace

void ReportTotal::add(const BakeReport& report, const std::string& name, std::uint64_t instances) {
    sum_.source.triangles += report.source.triangles * instances;
    sum_.source.vertices += report.source.vertices * instances;
    add_finding(sum_.findings.not_finite, report.findings.not_finite, instances);
    add_finding(sum_.findings.index_out_of_range, report.findings.index_out_of_range, instances);
    add_finding(sum_.findings.zero_area, report.findings.zero_area, instances);
    add_finding(sum_.findings.collapsed, report.findings.collapsed, instances);
    add_finding(sum_.findings.duplicate, report.findings.duplicate, instances);
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    sum_.tree.triangles =
        static_cast<std::uint32_t>(std::min(most, sum_.tree.triangles + report.tree.triangles * instances));
    sum_.seconds += report.seconds;
    for (const BakeWarning& warning : report.warnings) {
        const auto known = std::find_if(warnings_.begin(), warnings_.end(), [&warning](const CountedWarning& counted) {
            return counted.first.kind == warning.kind;
        });
        if (known != warnings_.end()) {
            ++known->meshes;
        } else {
            const std::string place = name.empty() ? "the merged mesh" : name;
            warnings_.push_back({{warning.kind, text(place, ": ", warning.message)}, 1});
        }
    }
}

BakeReport ReportTotal::report() const {
    BakeReport total = sum_;
    for (const CountedWarning& warning : warnings_) {
        total.warnings.push_back(warning.first);
        if (warning.meshes > 1)
            total.warnings.back().message += text(" The scene has ", warning.meshes, " such meshes.");
    }
    return total;
}

}  // namespace espalier::tools
