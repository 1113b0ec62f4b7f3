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
    return report.duplicate.count != 0 || report.zero_area.count != 0 || report.triangles == 0;
}

/// The fewest bits above those of the report with which the source stays closed; 0 if there are none.
unsigned bits_that_keep_closed(const Source& source, const SourceBounds& bounds, const BakeReport& report) {
    BakeReport ignored;
    for (unsigned bits = report.bits + 1; bits <= format::max_bits; ++bits) {
        const auto lattice = lattice_for_bits(bounds, bits);
        if (!lattice) break;
        if (is_closed(snap_and_weld(source, *lattice, ignored))) return bits;
    }
    return 0;
}

}  // namespace

void report_lost_closed(const Source& source, const SourceBounds& bounds, BakeReport& report) {
    report.lost_closed = !report.closed && may_have_lost_closed(source, report) && is_closed(source);
    report.bits_that_keep_closed = report.lost_closed ? bits_that_keep_closed(source, bounds, report) : 0;
}

}  // namespace espalier::baker
