#include <Jolt/Jolt.h>
#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/RayCast.h>

#include "../engines/jolt_start.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

// A MeshShape, whose triangles are quantised and whose bytes are those of its own statistics. It names a triangle by a
// number of its own and returns no u and v; neither is computed from it.
class JoltSystem final : public System {
public:
    explicit JoltSystem(const Mesh& mesh) : sphere_(bounding_sphere(mesh)) {
        start_jolt();
        const Stopwatch watch;
        shape_ = jolt_mesh(mesh);
        seconds_ = watch.seconds();
    }
    [[nodiscard]] std::size_t bytes() const override { return shape_->GetStats().mSizeBytes; }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const JPH::RayCast query = to_query(rays[i]);
            JPH::RayCastResult result;
            hits[i].found = shape_->CastRay(query, {}, result);
            if (!hits[i].found) continue;
            const JPH::Vec3 normal =
                shape_->GetSurfaceNormal(result.mSubShapeID2, query.GetPointOnRay(result.mFraction));
            hits[i].t = result.mFraction * reach(rays[i], sphere_);
            hits[i].normal = {normal.GetX(), normal.GetY(), normal.GetZ()};
            hits[i].id = result.mSubShapeID2.GetValue();
        }
    }
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        JPH::RayCastSettings settings;
        settings.SetBackFaceMode(JPH::EBackFaceMode::CollideWithBackFaces);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            JPH::AnyHitCollisionCollector<JPH::CastRayCollector> collector;
            shape_->CastRay(to_query(rays[i]), settings, {}, collector);
            answers[i] = collector.HadHit();
        }
    }

private:
    [[nodiscard]] JPH::RayCast to_query(const Ray& ray) const {
        const float end = reach(ray, sphere_);
        return {{ray.origin.x, ray.origin.y, ray.origin.z},
                end * JPH::Vec3(ray.direction.x, ray.direction.y, ray.direction.z)};
    }
    BoundingSphere sphere_;
    JPH::Ref<JPH::Shape> shape_;
    double seconds_ = 0.0;
};

}  // namespace

std::vector<Maker> jolt_makers() {
    const std::string version = std::to_string(JPH_VERSION_MAJOR) + "." + std::to_string(JPH_VERSION_MINOR) + "." +
                                std::to_string(JPH_VERSION_PATCH);
    return {{"jolt", "mesh shape", version, [](const Mesh& mesh) { return std::make_unique<JoltSystem>(mesh); }}};
}

}  // namespace espalier::bench
