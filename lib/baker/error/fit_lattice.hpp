// Which lattice: the one that the user's bits or step give, or a coarse one that keeps the user's tolerance.
#pragma once

#include <baker/base/expected.hpp>
#include <baker/error/measure_error.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct FittedMesh {
    LatticeMesh mesh;
    MeasuredError error;
};

/// Snaps, welds and measures; under a tolerance as often as it takes for the measured error to keep it.
Expected<FittedMesh> fit_lattice(const Source& source, const SourceBounds& bounds, Resolution resolution,
                                 Findings& findings);

}  // namespace espalier::baker
