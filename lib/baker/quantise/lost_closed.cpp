#include <baker/quantise/lost_closed.hpp>

#include <baker/quantise/closed.hpp>
#include <baker/quantise/snap.hpp>

namespace espalier::baker {

namespace {

/// Edges that cancel in the source have the same end points on the lattice, and cancel there. A triangle that
/// collapses takes no boundary away: its edges cancel along its line. What is dropped with an area on the lattice does:
/// a duplicate, and a triangle without area in the source whose corners moved off their line. A surface of which
/// nothing is left is not closed either. Triangles without area alone are no surface that could be lost.
bool may_have_lost_closed(const Source& source, const BakeReport& report) {
    if (source.triangles.empty()) return false;
    const Findings& dropped = report.findings;
    return dropped.duplicate.count != 0 || dropped.zero_area.count != 0 || report.tree.triangles == 0;
}

}  // namespace

bool has_lost_closed(const Source& source, const BakeReport& report) {
    return !report.closed && may_have_lost_closed(source, report) && is_closed(source);
}

unsigned bits_that_keep_closed(const Source& source, const SourceBounds& bounds, unsigned bits) {
    Findings ignored;
    while (++bits <= format::max_bits) {
        const auto lattice = lattice_for_bits(bounds, bits);
        if (!lattice) break;
        if (is_closed(snap_and_weld(source, *lattice, ignored))) return bits;
    }
    return 0;
}

}  // namespace espalier::baker
