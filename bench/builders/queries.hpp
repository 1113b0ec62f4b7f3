// The queries that trees are compared by: rays, and pairs of a mesh with itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>
#include <espalier/transform.hpp>

#include "../../tests/support/meshes/mesh.hpp"

namespace espalier::bench {

struct QueryCounts {
    std::size_t rays = 100'000;
    std::size_t poses = 1'000;
};

/// What the queries of one blob did, the same on every machine.
struct Work {
    QueryCounters rays;
    PairCounters pairs;
    std::uint64_t answers = 0;  ///< a digest of them, the same for every tree over one mesh
    std::size_t touching_poses = 0;
};

struct Seconds {
    double rays = 0.0;
    double pairs = 0.0;
};

/// Incoherent rays, and poses of a second mesh of the same kind.
class Queries {
public:
    /// The poses are searched with the blob, which is made from the mesh.
    Queries(const tests::Mesh& mesh, const Blob& blob, const QueryCounts& counts);

    [[nodiscard]] Work count(const Blob& blob) const;
    /// Runs all queries once, in processor time.
    [[nodiscard]] Seconds time(const Blob& blob) const;

private:
    std::vector<Ray> rays_;
    std::vector<Transform> poses_;
};

}  // namespace espalier::bench
