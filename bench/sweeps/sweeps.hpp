// Bullet's convex sweep over its triangle mesh. Compiled where Bullet is installed.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

class BulletSweeps {
public:
    explicit BulletSweeps(const Mesh& mesh);
    ~BulletSweeps();
    BulletSweeps(const BulletSweeps&) = delete;
    BulletSweeps& operator=(const BulletSweeps&) = delete;

    // Prepare the next shape. None has a margin.
    /// The half axes are perpendicular.
    void add_box(const OrientedBox& box);
    /// The vertices are relative to the start.
    void add_hull(std::span<const Vec3> vertices);
    /// Returns the share of the way up to the first contact, 1 if there is none.
    [[nodiscard]] float first_contact(std::size_t shape, Vec3 start, Vec3 way) const;

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace espalier::bench
