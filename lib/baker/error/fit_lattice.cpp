#include <baker/error/fit_lattice.hpp>

#include <algorithm>
#include <cmath>

#include <baker/base/number_text.hpp>
#include <baker/quantise/snap.hpp>

namespace espalier::baker {

namespace {

FittedMesh snap_and_measure(const Source& source, const Lattice& lattice, Findings& findings) {
    FittedMesh fitted{snap_and_weld(source, lattice, findings), {}};
    fitted.error = measure_error(source, fitted.mesh);
    return fitted;
}

Refusal too_far_away(const Source& source, const FittedMesh& fitted) {
    return {BakeStatus::too_large,
            triangle_name(source, fitted.error.dropped_triangle) +
                ": it has no area and lies so far from all others that the distance cannot be "
                "written; remove it from the mesh",
            place_of(source, fitted.error.dropped_triangle)};
}

/// Of float64 positions so far from 0 that float32, which lattice points have, moves them by more than the tolerance.
Refusal needs_origin(const SourceBounds& bounds, double tolerance) {
    return {BakeStatus::too_fine,
            "a tolerance of " + number_text(tolerance) +
                " is finer than float32, which blobs have, is at coordinates of " +
                number_text(bounds.largest_coordinate) +
                "; choose an origin near the meshes, or let the baker choose one, or choose a coarser tolerance"};
}

Refusal tolerance_error(const Source& source, const SourceBounds& bounds, const FittedMesh& last, double tolerance,
                        const Refusal& too_fine) {
    const int exponent = step_exponent_for_tolerance(tolerance);
    const bool is_small_enough = bounds.largest_side < std::ldexp(1.0, exponent + format::max_bits);
    if (source.is_float64 && is_small_enough && is_below_float_spacing({{}, exponent, 0}, bounds))
        return needs_origin(bounds, tolerance);
    if (!last.error.is_of_dropped) return too_fine;
    return {BakeStatus::too_fine,
            triangle_name(source, last.error.dropped_triangle) + ": it has no area on the lattice and lies " +
                number_text(double(last.error.largest)) +
                " from the rest, so that dropping it exceeds the tolerance of " + number_text(tolerance) +
                "; remove it from the mesh, or choose a coarser tolerance",
            place_of(source, last.error.dropped_triangle)};
}

/// Queries near the asset are rounded to 2^-6 of a step (docs/numerics.md, 2). So on a lattice up to this many bits
/// coarser than one that keeps any vertex within the tolerance, queries move by no more than the tolerance either.
constexpr int query_fraction_bits = 6;

/// Whether a blob or float32 queries have no use for a lattice as fine.
bool is_finer_than_useful(const SourceBounds& bounds, int exponent, double tolerance) {
    const auto lattice = lattice_for_tolerance(bounds, exponent, tolerance);
    return !lattice || is_below_float_spacing(*lattice, bounds);
}

/// The coarsest exponent worth a try: at least the one that keeps any vertex within the tolerance, coarser while these
/// vertices happen to stay within it and queries do too, and not so coarse that the whole mesh becomes a point.
int first_exponent(const Source& source, const SourceBounds& bounds, double tolerance) {
    int coarsest = 0;
    std::frexp(bounds.largest_side, &coarsest);
    coarsest = std::min(coarsest, format::max_step_exponent);
    int exponent = std::min(step_exponent_for_tolerance(tolerance), coarsest);
    const int coarsest_for_queries = exponent + query_fraction_bits;
    // mutant(without 8, + -> -, + -> right side dropped) work: tries coarser lattices in vain: their points are points
    // of all finer ones
    while (exponent < coarsest && exponent >= format::min_step_exponent &&
           (exponent < coarsest_for_queries || is_finer_than_useful(bounds, exponent, tolerance)) &&
           vertices_are_within(source, exponent + 1, tolerance)) {
        ++exponent;
    }
    return exponent;
}

Expected<FittedMesh> fit_tolerance(const Source& source, const SourceBounds& bounds, double tolerance,
                                   Findings& findings) {
    FittedMesh last;
    for (int exponent = first_exponent(source, bounds, tolerance);; --exponent) {
        const auto lattice = lattice_for_tolerance(bounds, exponent, tolerance);
        if (!lattice) return tolerance_error(source, bounds, last, tolerance, lattice.refusal());
        last = snap_and_measure(source, *lattice, findings);
        // A surface that vanished as a whole keeps no tolerance.
        const bool is_something_left = !last.mesh.triangles.empty();
        if (is_something_left && double(last.error.largest) <= tolerance) return last;
    }
}

/// Returns the lattice that a step or bits give; for a tolerance that of a mesh without triangles.
Expected<Lattice> fixed_lattice(const SourceBounds& bounds, Resolution resolution) {
    switch (resolution.kind()) {
        case Resolution::Kind::bits:
            return lattice_for_bits(bounds, static_cast<unsigned>(resolution.value()));
        case Resolution::Kind::step:
            return lattice_for_step(bounds, static_cast<int>(resolution.value()));
        case Resolution::Kind::tolerance:
            break;
    }
    return Lattice{};
}

}  // namespace

Expected<FittedMesh> fit_lattice(const Source& source, const SourceBounds& bounds, Resolution resolution,
                                 Findings& findings) {
    if (resolution.kind() == Resolution::Kind::tolerance && !source.triangles.empty())
        return fit_tolerance(source, bounds, resolution.value(), findings);
    const auto lattice = fixed_lattice(bounds, resolution);
    if (!lattice) return lattice.refusal();
    FittedMesh fitted = snap_and_measure(source, *lattice, findings);
    if (!std::isfinite(fitted.error.largest)) return too_far_away(source, fitted);
    return fitted;
}

}  // namespace espalier::baker
