#include "box3d.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

// It names a triangle by its own order and returns no u and v; neither is computed from it. It meets front faces alone,
// and has no query for any hit of a mesh.
class Box3dSystem final : public System {
public:
    explicit Box3dSystem(const Mesh& mesh) : sphere_(bounding_sphere(mesh)), mesh_(mesh) {}
    [[nodiscard]] std::size_t bytes() const override { return mesh_.bytes(); }
    [[nodiscard]] double build_seconds() const override { return mesh_.build_seconds(); }
    [[nodiscard]] bool has_any() const override { return false; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        const b3Mesh mesh = mesh_.get();
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray& ray = rays[i];
            const float end = reach(ray, sphere_);
            const b3RayCastInput query = {to_box3d(ray.origin), to_box3d(tests::times(ray.direction, end)), 1.0f};
            const b3CastOutput result = b3RayCastMesh(&mesh, &query);
            hits[i].found = result.hit;
            if (!result.hit) continue;
            hits[i].t = result.fraction * end;
            hits[i].normal = {result.normal.x, result.normal.y, result.normal.z};
            hits[i].id = static_cast<std::uint32_t>(result.triangleIndex);
        }
    }
    void any(const std::vector<Ray>&, std::vector<std::uint8_t>&) override {}

private:
    BoundingSphere sphere_;
    Box3dMesh mesh_;
};

}  // namespace

std::vector<Maker> box3d_makers() {
    const b3Version v = b3GetVersion();
    return {{"box3d", "mesh",
             std::to_string(v.major) + "." + std::to_string(v.minor) + "." + std::to_string(v.revision),
             [](const Mesh& mesh) { return std::make_unique<Box3dSystem>(mesh); }}};
}

}  // namespace espalier::bench
