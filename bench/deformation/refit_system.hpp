// The interface of a system whose tree over a mesh is renewed when the mesh moves.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <espalier/shapes.hpp>

#include "../rays.hpp"

namespace espalier::bench {

/// What a refit of Espalier renews, and the memory that it needs.
struct RefitWork {
    std::size_t nodes = 0;
    std::size_t leaves = 0;
    std::size_t leaf_vertices = 0;  ///< of all leaves together
    std::size_t moving_bytes = 0;   ///< in RAM
    std::size_t source_bytes = 0;   ///< of the rest, which may stay in flash: where each leaf vertex comes from
    std::size_t still_bytes = 0;    ///< the rest
    double step = 0.0;              ///< of the lattice
};

/// A tree, and a copy of the positions that belongs to the system.
class RefitSystem {
public:
    virtual ~RefitSystem() = default;
    /// Copies positions to where refit() reads them. No part of a measurement.
    virtual void set_positions(const std::vector<Vec3>& positions) = 0;
    virtual void refit() = 0;
    /// Tests whether the outermost box contains a point, up to `rounding`.
    [[nodiscard]] virtual bool contains(const Vec3& point, float rounding) const = 0;
    /// Returns the bytes of the tree and of everything else that its queries read.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
    [[nodiscard]] virtual std::optional<RefitWork> work() const { return std::nullopt; }
};

struct RefitMaker {
    std::string system, profile, version;
    /// The mesh is at rest and outlives the system. All poses lie in `range`.
    std::function<std::unique_ptr<RefitSystem>(const Mesh& mesh, const Box& range)> make;
    /// Whether the outermost box may lack positions of a pose with flat triangles; such poses are then counted.
    bool may_lose_flat_poses = false;

    [[nodiscard]] std::string name() const { return system + ' ' + profile; }
};
using RefitMakers = std::vector<RefitMaker>;

inline bool is_within(const Vec3& point, const Box& box, float rounding) {
    return point.x >= box.min.x - rounding && point.x <= box.max.x + rounding && point.y >= box.min.y - rounding &&
           point.y <= box.max.y + rounding && point.z >= box.min.z - rounding && point.z <= box.max.z + rounding;
}

// Each in a file of its own, which is compiled where the system is installed.
RefitMakers espalier_refit_makers(unsigned bits);
RefitMakers textbook_refit_makers();
RefitMakers embree_refit_makers();
RefitMakers bullet_refit_makers();
RefitMakers fcl_refit_makers();

}  // namespace espalier::bench
