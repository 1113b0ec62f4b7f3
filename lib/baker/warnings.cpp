#include <baker/warnings.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <baker/base/number_text.hpp>
#include <baker/quantise/lost_closed.hpp>

namespace espalier {

namespace baker {

namespace {

constexpr unsigned coarse_ray_bits = 23;  // from here on the asset fills the grid of rays, which is then whole steps

std::string counted(std::uint64_t count, const char* singular) {
    return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

std::string step_text(const Source& source, const BakeReport& report) {
    if (source.is_float64)
        return "the lattice step " + short_number_text(report.lattice.step) +
               " is finer than the spacing of float32 this far from the origin, to which lattice points are rounded: "
               "choose an origin near the mesh, or let the baker choose one, unless the blob is deformable.";
    return "the lattice step " + short_number_text(report.lattice.step) +
           " is finer than the spacing of the source's own floats at its coordinates: fewer bits or a coarser "
           "tolerance "
           "loses nothing, and an origin near the asset gains accuracy.";
}

/// Returns why the baked surface is not closed, though the source is, and what keeps it closed.
std::string lost_closed_text(const BakeReport& report) {
    std::string dropped;
    std::string advice;
    const auto add = [&](const Finding& finding, const char* what, const char* remedy) {
        if (finding.count == 0) return;
        dropped += (dropped.empty() ? "" : " and ") + counted(finding.count, "triangle") + " " + what +
                   " (first: " + finding.first + ")";
        advice += (advice.empty() ? ": " : "; ") + std::string(remedy);
    };
    if (report.tree.triangles != 0) {
        add(report.findings.duplicate, "with the corners of another one",
            "bake parts that share triangles into separate blobs");
        add(report.findings.zero_area, "without area",
            "split the long edge beside a triangle without area, and remove that one");
    }
    const std::string reason = dropped.empty() ? "no triangle is left" : "it lacks " + dropped;
    if (advice.empty()) advice = ": it is too thin for its length";
    const unsigned bits = report.bits_that_keep_closed;
    const std::string keeping = bits == 0 ? "No number of bits keeps it closed" + advice
                                          : "A lattice of " + counted(bits, "bit") + " keeps it closed";
    return "the source is closed, but at " + counted(report.lattice.bits, "bit") +
           " the baked surface is not, because " + reason + ": inside and signed-distance queries will refuse it. " +
           keeping + ".";
}

std::string rays_text(const BakeReport& report) {
    return "at " + counted(report.lattice.bits, "bit") +
           " rays that start outside of the asset are rounded to whole lattice steps, coarser than float32: one that "
           "is "
           "aimed exactly at a corner may miss it. 22 bits or fewer leave room for a finer grid.";
}

}  // namespace

void add_warnings(const Source& source, const SourceBounds& bounds, const Lattice& lattice, LostClosed lost_closed,
                  BakeReport& report) {
    const auto add = [&report](BakeWarning::Kind kind, std::string message) {
        report.warnings.push_back({kind, std::move(message)});
    };
    if (is_below_float_spacing(lattice, bounds))
        add(BakeWarning::Kind::step_below_float_spacing, step_text(source, report));
    if (lost_closed == LostClosed::tested && has_lost_closed(source, report)) {
        report.bits_that_keep_closed = bits_that_keep_closed(source, bounds, report.lattice.bits);
        add(BakeWarning::Kind::lost_closed, lost_closed_text(report));
    }
    if (report.tree.triangles != 0 && report.lattice.bits >= coarse_ray_bits)
        add(BakeWarning::Kind::rays_rounded_coarsely, rays_text(report));
}

}  // namespace baker

bool BakeReport::warns_of(BakeWarning::Kind kind) const noexcept {
    return std::ranges::any_of(warnings, [kind](const BakeWarning& warning) { return warning.kind == kind; });
}

}  // namespace espalier
