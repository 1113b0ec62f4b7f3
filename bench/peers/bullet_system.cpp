#include "bullet.hpp"
#include "system.hpp"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace espalier::bench {
namespace {

/// Keeps the closest triangle; Bullet's own callback tests it and shortens the segment.
class ClosestTriangle final : public btTriangleRaycastCallback {
public:
    ClosestTriangle(const btVector3& from, const btVector3& to)
        : btTriangleRaycastCallback(from, to, kF_KeepUnflippedNormal) {}
    btScalar reportHit(const btVector3& unit_normal, btScalar fraction, int, int index) override {
        normal = unit_normal;
        triangle = index;
        return fraction;
    }
    btVector3 normal;
    int triangle = -1;
};

// btBvhTriangleMeshShape over a quantised btOptimizedBvh. Bytes are what Bullet's serialiser says the tree has, and the
// caller's float32 vertices and indices, which it reads in place. It gives fraction, normal and index; u and v are
// computed from them. The callback cannot end a walk, so there is no any-hit query.
class BulletSystem final : public System {
public:
    explicit BulletSystem(const Mesh& mesh)
        : mesh_(mesh), sphere_(bounding_sphere(mesh)), arrays_(bullet_arrays(mesh)) {
        const Stopwatch watch;
        shape_ = std::make_unique<btBvhTriangleMeshShape>(&arrays_, true);
        seconds_ = watch.seconds();
    }
    [[nodiscard]] std::size_t bytes() const override { return bullet_bytes(*shape_, mesh_); }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    [[nodiscard]] bool has_any() const override { return false; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const float end = reach(rays[i], sphere_);
            const Vec3 from = rays[i].origin, to = along(rays[i], end);
            ClosestTriangle callback({from.x, from.y, from.z}, {to.x, to.y, to.z});
            shape_->performRaycast(&callback, callback.m_from, callback.m_to);
            Hit& hit = hits[i];
            hit.found = callback.triangle >= 0;
            if (!hit.found) continue;
            hit.t = callback.m_hitFraction * end;
            hit.normal = {callback.normal.x(), callback.normal.y(), callback.normal.z()};
            hit.id = static_cast<std::uint32_t>(callback.triangle);
            set_barycentric(mesh_, hit.id, along(rays[i], hit.t), hit);
        }
    }
    void any(const std::vector<Ray>&, std::vector<std::uint8_t>&) override {}

private:
    const Mesh& mesh_;
    BoundingSphere sphere_;
    btTriangleIndexVertexArray arrays_;
    std::unique_ptr<btBvhTriangleMeshShape> shape_;
    double seconds_ = 0.0;
};

}  // namespace

std::vector<Maker> bullet_makers() {
    return {{"bullet", "quantised", bullet_version(),
             [](const Mesh& mesh) { return std::make_unique<BulletSystem>(mesh); }}};
}

}  // namespace espalier::bench
