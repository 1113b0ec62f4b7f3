#include <baker/policy.hpp>

#include <string>

#include <baker/base/number_text.hpp>

namespace espalier::baker {

LostTriangles lost_triangles(const BakeReport& report) {
    const Findings& findings = report.findings;
    const std::string of_lattice = "without area on the lattice of step " + short_number_text(report.lattice.step);
    const struct {
        const char* words;
        const Finding& finding;
        std::uint64_t count;
    } reasons[] = {
        {"not finite", findings.not_finite, findings.not_finite.count},
        {"with an index out of range", findings.index_out_of_range, findings.index_out_of_range.count},
        {"without area", findings.zero_area, findings.zero_area.count - findings.equal_corners},
        {of_lattice.c_str(), findings.collapsed, findings.collapsed.count},
    };
    LostTriangles lost;
    lost.of = report.source.triangles - findings.equal_corners;
    for (const auto& reason : reasons) {
        if (reason.count == 0) continue;
        lost.count += reason.count;
        if (!lost.place) lost.place = reason.finding.place;
        lost.words += (lost.words.empty() ? "" : ", ") + std::to_string(reason.count) + " " + reason.words +
                      " (first: " + reason.finding.first + ")";
    }
    return lost;
}

std::optional<Refusal> judge(const BakePolicy& policy, const BakeReport& report) {
    const LostTriangles lost = lost_triangles(report);
    if (lost.are_more_than(policy.max_dropped))
        return Refusal{BakeStatus::invalid_mesh,
                       "dropped " + std::to_string(lost.count) + " of " + std::to_string(lost.of) +
                           (lost.of == 1 ? " triangle: " : " triangles: ") + lost.words + ". At most " +
                           short_number_text(policy.max_dropped) + " % may be (max_dropped). Mend the mesh" +
                           (report.findings.collapsed.count != 0 ? " or choose a finer lattice" : "") +
                           "; if the loss is intended, raise max_dropped" +
                           (report.tree.triangles == 0 && !policy.allow_empty ? " and set allow_empty" : ""),
                       lost.place};
    if (report.tree.triangles == 0 && !policy.allow_empty)
        return Refusal{BakeStatus::invalid_mesh,
                       "no triangle is left. Check the meshes; if an empty blob is intended, set allow_empty"};
    if (policy.strict && !report.warnings.empty())
        return Refusal{BakeStatus::invalid_mesh, "strict refuses a warning: " + report.warnings.front().message};
    return std::nullopt;
}

}  // namespace espalier::baker
