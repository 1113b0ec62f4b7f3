// A k-DOP that is turned is no k-DOP of the same directions: it is enclosed in a new one ("Rapid collision detection by
// dynamically aligned DOP-trees", Zachmann 1998).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tests.hpp"

namespace espalier::bench {

/// Computes how far a placed k-DOP reaches along each normal from how far it reaches along three of its own normals.
/// Which three depends on the pose alone: the normal, turned back, is a sum of them with weights that are not negative.
template <std::size_t k>
class DopTurn {
public:
    explicit DopTurn(const Pose& pose);

    /// Encloses `from`, placed, in `to`. Both are as in StoredDop.
    void enclose(const float (&from)[k], float (&to)[k]) const {
        for (std::size_t i = 0; i < k / 2; ++i) {
            const Sum& s = sums_[i];
            to[i] = s.weights[0] * from[s.normals[0]] + s.weights[1] * from[s.normals[1]] +
                    s.weights[2] * from[s.normals[2]] + s.shift;
            to[i + k / 2] = s.weights[0] * from[s.opposites[0]] + s.weights[1] * from[s.opposites[1]] +
                            s.weights[2] * from[s.opposites[2]] - s.shift;
        }
    }

private:
    struct Sum {
        std::uint8_t normals[3];
        std::uint8_t opposites[3];
        float weights[3];
        float shift;  ///< of the pose, along the normal
    };
    std::array<Sum, k / 2> sums_;
};

extern template class DopTurn<14>;
extern template class DopTurn<18>;
extern template class DopTurn<26>;

}  // namespace espalier::bench
