// A mesh that moves, on a lattice that holds its range of motion.
#pragma once

#include <vector>

#include <espalier/bake.hpp>

#include <baker/base/expected.hpp>
#include <baker/error/fit_lattice.hpp>
#include <baker/input/source.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Returns the box in which all positions of all poses lie.
[[nodiscard]] SourceBounds range_of(const Source& source, const Deformation& deformation);

/// Places each position of the source on the lattice, unused ones too; none is welded, and flat triangles stay.
/// Vertices have the numbers of positions, and `extent` is that of the range. The error bounds that of every pose.
[[nodiscard]] Expected<FittedMesh> fit_range(const Source& source, const SourceBounds& range, Resolution resolution,
                                             Findings& findings);

/// Returns the lattice points of positions that lie in the range.
[[nodiscard]] LatticePoint place(const Vec3d& position, const Lattice& lattice);

}  // namespace espalier::baker
