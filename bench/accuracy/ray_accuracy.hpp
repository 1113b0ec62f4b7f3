// Closest hits on the blob, judged by the same rays on the source in double precision.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>

#include "../../tests/oracle/double_tree.hpp"

namespace espalier::bench {

/// What the source answers, found once and held against every lattice.
[[nodiscard]] std::vector<reference::ReferenceHit> reference_hits(const reference::DoubleTree& source,
                                                                  const std::vector<Ray>& rays);

/// Prints fields of a JSON object, each after a comma: rays missed and extra, t, normals, and how far the points that
/// are answered lie from the source's surface (for the first `points` hits).
void print_ray_accuracy(const Blob& blob, const reference::DoubleTree& source, const std::vector<Ray>& rays,
                        const std::vector<reference::ReferenceHit>& references, std::size_t points);

}  // namespace espalier::bench
