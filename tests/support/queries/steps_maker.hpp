// Boxes and segments in lattice steps to ask a blob with: half of them touch it, run through its corners or along its
// sides, or are as far away as they may be.
#pragma once

#include <cstdint>
#include <string>

#include <espalier/advanced/lattice.hpp>

#include "surface.hpp"

namespace espalier::tests {

class StepsMaker : public SurfaceMaker {
public:
    using SurfaceMaker::SurfaceMaker;

    LatticeBox box(bool awkward);
    LatticeSegment segment(bool awkward);

private:
    [[nodiscard]] std::int32_t extent(std::size_t axis) const;
    /// In the asset's box or up to half its size beside it.
    GridPoint anywhere();
    /// The middle of a side, or near to it.
    GridPoint side_middle();
};

std::string describe(const LatticeBox& box);
std::string describe(const LatticeSegment& segment);

}  // namespace espalier::tests
