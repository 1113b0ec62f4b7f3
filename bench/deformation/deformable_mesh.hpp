// A deformable mesh that owns its bytes: blob and moving part.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "../rays.hpp"
#include "refit_system.hpp"

namespace espalier::bench {

/// How to bake a deformable mesh.
struct DeformableOptions {
    Box range;
    unsigned bits = 16;
    std::vector<std::vector<Vec3>> poses = {};
    unsigned max_leaf_triangles = format::max_leaf_triangles;
    Effort effort = Effort::normal;
};

class DeformableMesh {
public:
    /// Throws std::runtime_error with the reason of the baker.
    DeformableMesh(const Mesh& mesh, const DeformableOptions& options);
    DeformableMesh(const DeformableMesh&) = delete;
    DeformableMesh& operator=(const DeformableMesh&) = delete;

    /// Throws std::runtime_error if refit() refuses the positions. Returns the quality.
    float move(std::span<const Vec3> positions);
    /// Returns what move() calls.
    [[nodiscard]] RefitResult refit(std::span<const Vec3> positions) { return espalier::refit(deformable_, positions); }
    [[nodiscard]] const Blob& blob() const { return deformable_.blob(); }
    [[nodiscard]] const RefitWork& work() const { return work_; }
    [[nodiscard]] double bake_seconds() const { return bake_seconds_; }

private:
    std::vector<std::byte> bytes_, memory_;
    Deformable deformable_;
    RefitWork work_;
    double bake_seconds_ = 0.0;
};

}  // namespace espalier::bench
