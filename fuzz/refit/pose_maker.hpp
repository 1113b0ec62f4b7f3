// Poses for a walk: in the range of motion, at its ends, flat, near the one before, and some that refit() refuses.
#pragma once

#include <vector>

#include <espalier/types.hpp>

#include "refit/pose_model.hpp"
#include "support/base/random.hpp"
#include "support/format/decoder.hpp"

namespace espalier::fuzz {

class PoseMaker {
public:
    PoseMaker(const tests::DecodedBlob& blob, const PoseModel& model, std::vector<Vec3> first_pose);

    /// Returns the next pose, which begins with the one before where that was not refused.
    std::vector<Vec3> next(tests::Random& random);
    /// Makes a pose the one before.
    void keep(const std::vector<Vec3>& pose) { last_ = pose; }

private:
    Vec3 anywhere(tests::Random& random) const;
    Vec3 at_an_end(tests::Random& random) const;
    Vec3 on_small_grid(tests::Random& random) const;
    void flatten(std::vector<Vec3>& pose, tests::Random& random) const;
    void wave(std::vector<Vec3>& pose, tests::Random& random) const;
    std::uint32_t& any_used(tests::Random& random);

    const tests::DecodedBlob& blob_;
    const PoseModel& model_;
    std::vector<std::uint32_t> used_;  ///< the positions that a triangle has
    std::vector<Vec3> first_;
    std::vector<Vec3> last_;
};

}  // namespace espalier::fuzz
