// How far the answers of two systems are the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "system.hpp"

namespace espalier::bench {

struct Agreement {
    std::size_t disagreeing = 0;    ///< one says hit, the other miss
    std::size_t t_disagreeing = 0;  ///< both hit, but further apart than rounding explains
};

/// `max_error` is how far the surface of `own` may be from that of `reference`. `size` is the largest coordinate that
/// took part in the computation, which sets the unit of its rounding.
Agreement compare(const std::vector<Ray>& rays, const std::vector<Hit>& reference, const std::vector<Hit>& own,
                  double max_error, double size);

/// Rays to which a system's any-hit query says something else than its closest-hit query.
std::size_t contradictions(const std::vector<Hit>& closest, const std::vector<std::uint8_t>& any);

}  // namespace espalier::bench
