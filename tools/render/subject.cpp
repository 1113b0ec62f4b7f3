#include "subject.hpp"

#include <cmath>
#include <cstdint>

#include <espalier/transform.hpp>
#include <espalier/walk.hpp>

namespace espalier::tools {

namespace {

RayHit hit_of(const Blob& blob, const Ray& ray) { return raycast(blob, ray); }
RayHit hit_of(const BakedScene& scene, const Ray& ray) { return *raycast(scene, ray); }

float step_of(const Blob& blob) { return std::ldexp(1.0f, blob.lattice().step_exponent); }
float step_of(const BakedScene& scene) { return detail::data_of(scene).coarsest_step; }

/// Visits the corners of all triangles.
void visit_corners(const Blob& blob, const std::function<void(Vec3)>& visit) {
    static_cast<void>(for_each_triangle(blob, [&](TriangleId, const Triangle& corners) {
        for (const Vec3& corner : {corners.a, corners.b, corners.c}) visit(corner);
        return Visit::next;
    }));
}

/// Visits the corners of the boxes of all instances.
void visit_corners(const BakedScene& scene, const std::function<void(Vec3)>& visit) {
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const Instance instance = *instance_at(scene, {i});
        const Result<Blob> mesh = mesh_at(scene, {i});
        if (mesh && mesh->triangle_count() == 0) continue;
        const Box bounds = mesh ? mesh->bounds() : scene.tiles()[instance.mesh - scene.meshes().size()].bounds();
        const Vec3 low = bounds.min;
        const Vec3 high = bounds.max;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3 point{(corner & 1u) != 0 ? high.x : low.x, (corner & 2u) != 0 ? high.y : low.y,
                             (corner & 4u) != 0 ? high.z : low.z};
            visit(to_world(instance.transform, point));
        }
    }
}

/// A subject that is a blob or a scene.
template <class Surface>
class SubjectOf final : public Subject {
public:
    explicit SubjectOf(const Surface& surface) : surface_(surface) {}

    [[nodiscard]] RayHit closest_hit(const Ray& ray) const override { return hit_of(surface_, ray); }
    [[nodiscard]] bool is_hit(const Ray& ray) const override { return occluded(surface_, ray).yes(); }
    [[nodiscard]] Box bounds() const override { return surface_.bounds(); }
    [[nodiscard]] float step() const override { return step_of(surface_); }
    void for_each_corner(const std::function<void(Vec3)>& visit) const override { visit_corners(surface_, visit); }

private:
    const Surface& surface_;
};

}  // namespace

std::unique_ptr<Subject> subject_of(const Blob& blob) { return std::make_unique<SubjectOf<Blob>>(blob); }
std::unique_ptr<Subject> subject_of(const BakedScene& scene) { return std::make_unique<SubjectOf<BakedScene>>(scene); }

}  // namespace espalier::tools
