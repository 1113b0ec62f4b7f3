// Espalier's part: the cloth as a deformable mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

namespace flag {

/// Its calls throw std::runtime_error if Espalier refuses one.
class Collider {
public:
    /// Bakes the cloth. Poses are examples of its motion: the tree suits them, and the range of motion holds them.
    Collider(std::span<const espalier::Vec3> rest, std::span<const espalier::TriangleVertices> triangles,
             const std::vector<std::vector<espalier::Vec3>>& poses);
    Collider(const Collider&) = delete;
    Collider& operator=(const Collider&) = delete;
    ~Collider() = default;

    /// Moves the vertices. Returns the quality of the tree.
    float move(std::span<const espalier::Vec3> positions);
    /// Returns the cloth in its latest pose, for queries.
    [[nodiscard]] const espalier::Blob& blob() const { return mesh_.blob(); }
    /// Returns the cloth in its latest pose as a whole blob.
    [[nodiscard]] std::vector<std::byte> seal() const;

    /// Returns the bytes that move, and those that stay as they were baked.
    [[nodiscard]] std::size_t moving_bytes() const { return memory_.size(); }
    [[nodiscard]] std::size_t resting_bytes() const { return baked_.size() - memory_.size(); }

private:
    std::vector<std::byte> baked_;   // may lie in flash
    std::vector<std::byte> memory_;  // the part that moves
    espalier::Deformable mesh_;
};

}  // namespace flag
