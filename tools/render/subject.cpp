#include "subject.hpp"

#include <cmath>

#include <espalier/transform.hpp>
#include <espalier/walk.hpp>

namespace espalier::tools {

RayHit BlobSubject::closest_hit(const Ray& ray) const { return raycast(blob_, ray); }
bool BlobSubject::is_hit(const Ray& ray) const { return occluded(blob_, ray).yes(); }
Box BlobSubject::bounds() const { return {blob_.bounds().min, blob_.bounds().max}; }
float BlobSubject::step() const { return std::ldexp(1.0f, blob_.lattice().step_exponent); }

void BlobSubject::for_each_corner(const std::function<void(Vec3)>& visit) const {
    static_cast<void>(for_each_triangle(blob_, [&](TriangleId, const Triangle& corners) {
        for (const Vec3& corner : {corners.a, corners.b, corners.c}) visit(corner);
        return Visit::next;
    }));
}

RayHit SceneSubject::closest_hit(const Ray& ray) const { return *raycast(scene_, ray); }
bool SceneSubject::is_hit(const Ray& ray) const { return occluded(scene_, ray).yes(); }
Box SceneSubject::bounds() const { return scene_.bounds(); }
float SceneSubject::step() const { return detail::data_of(scene_).coarsest_step; }

void SceneSubject::for_each_corner(const std::function<void(Vec3)>& visit) const {
    for (std::uint32_t i = 0; i < scene_.instance_count(); ++i) {
        const Instance instance = *instance_at(scene_, {i});
        const Result<Blob> mesh = mesh_at(scene_, {i});
        if (mesh && mesh->triangle_count() == 0) continue;
        const Box bounds = mesh ? mesh->bounds() : scene_.tiles()[instance.mesh - scene_.meshes().size()].bounds();
        const Vec3 low = bounds.min;
        const Vec3 high = bounds.max;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Vec3 point{(corner & 1u) != 0 ? high.x : low.x, (corner & 2u) != 0 ? high.y : low.y,
                             (corner & 4u) != 0 ? high.z : low.z};
            visit(to_world(instance.transform, point));
        }
    }
}

}  // namespace espalier::tools
