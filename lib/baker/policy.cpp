#include <baker/policy.hpp>

#include <string>

#include <baker/base/number_text.hpp>

namespace espalier::baker {

namespace {

/// A reason for which triangles are lost.
struct Loss {
    const char* words;
    const Finding& finding;
    std::uint64_t count;
};

std::optional<Refusal> judge_dropped(const BakePolicy& policy, const BakeReport& report) {
    const Findings& findings = report.findings;
    const Loss losses[] = {
        {"not finite", findings.not_finite, findings.not_finite.count},
        {"with an index out of range", findings.index_out_of_range, findings.index_out_of_range.count},
        {"without area", findings.zero_area, findings.zero_area.count - findings.equal_corners},
        {"without area on the lattice", findings.collapsed, findings.collapsed.count},
    };
    std::uint64_t lost = 0;
    std::string words;
    std::optional<SourcePlace> place;
    for (const Loss& loss : losses) {
        if (loss.count == 0) continue;
        lost += loss.count;
        if (!place) place = loss.finding.place;
        words += (words.empty() ? "" : ", ") + std::to_string(loss.count) + " " + loss.words +
                 " (first: " + loss.finding.first + ")";
    }
    const std::uint64_t of = report.source.triangles - findings.equal_corners;
    if (double(lost) * 100.0 <= policy.max_dropped * double(of)) return std::nullopt;
    return Refusal{BakeStatus::invalid_mesh,
                   "dropped " + std::to_string(lost) + " of " + std::to_string(of) +
                       (of == 1 ? " triangle: " : " triangles: ") + words + ". At most " +
                       short_number_text(policy.max_dropped) + " % may be (max_dropped). Mend the mesh" +
                       (findings.collapsed.count != 0 ? " or choose a finer lattice" : "") +
                       "; if the loss is intended, raise max_dropped" +
                       (report.tree.triangles == 0 && !policy.allow_empty ? " and set allow_empty" : ""),
                   place};
}

}  // namespace

std::optional<Refusal> judge(const BakePolicy& policy, const BakeReport& report) {
    if (auto refusal = judge_dropped(policy, report)) return refusal;
    if (report.tree.triangles == 0 && !policy.allow_empty)
        return Refusal{BakeStatus::invalid_mesh,
                       "no triangle is left. Check the meshes; if an empty blob is intended, set allow_empty"};
    if (policy.strict && !report.warnings.empty())
        return Refusal{BakeStatus::invalid_mesh, "strict refuses a warning: " + report.warnings.front().message};
    return std::nullopt;
}

}  // namespace espalier::baker
