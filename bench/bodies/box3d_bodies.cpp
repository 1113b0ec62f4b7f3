#include "../peers/box3d.hpp"
#include "bodies.hpp"

extern "C" int b3CollideMoverAndMesh(b3PlaneResult* planes, int capacity, const b3Mesh* shape, const b3Capsule* mover);

namespace espalier::bench {

namespace {

constexpr b3Transform identity = {{0.0f, 0.0f, 0.0f}, {{0.0f, 0.0f, 0.0f}, 1.0f}};

std::array<b3Vec3, 2> ends_of(const Capsule& capsule) { return {to_box3d(capsule.from), to_box3d(capsule.to)}; }

std::array<b3Vec3, 8> corners_of(const OrientedBox& box) {
    std::array<b3Vec3, 8> corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
        b3Vec3 at = to_box3d(box.center);
        for (unsigned i = 0; i < 3; ++i)
            at = b3MulAdd(at, (corner >> i & 1u) != 0 ? 1.0f : -1.0f, to_box3d(box.half_axes[i]));
        corners[corner] = at;
    }
    return corners;
}

b3AABB grown(const b3Vec3* points, int count, float by) { return b3MakeAABB(points, count, by); }

/// Calls `visit(corners)` for each triangle that a tree finds in a box.
template <class Visit>
void visit_triangles(const b3Mesh& mesh, const b3AABB& bounds, Visit visit) {
    b3QueryMesh(
        &mesh, bounds,
        [](b3Vec3 a, b3Vec3 b, b3Vec3 c, int, void* context) {
            const b3Vec3 corners[3] = {a, b, c};
            (*static_cast<Visit*>(context))(corners);
            return true;
        },
        &visit);
}

/// The points that `collide(manifold, corners)` finds with each triangle in a box.
template <class Collide>
float count_contacts(const b3Mesh& mesh, const b3AABB& bounds, Collide collide) {
    float count = 0.0f;
    visit_triangles(mesh, bounds, [&](const b3Vec3* corners) {
        b3LocalManifoldPoint points[32];
        b3LocalManifold manifold = {};
        manifold.points = points;
        collide(manifold, corners);
        count += static_cast<float>(manifold.pointCount);
    });
    return count;
}

}  // namespace

// Its contacts are those of each triangle, before it chooses some of them; it makes those of a whole body in a world
// only.
BodySystem box3d_bodies(const Mesh& mesh) {
    const auto own = std::make_shared<Box3dMesh>(mesh);
    BodySystem system = {"box3d", "", {}};
    const auto overlaps = [own](const b3Vec3* points, std::size_t count, float radius) {
        const b3Mesh shape = own->get();
        const b3ShapeProxy proxy = {points, static_cast<int>(count), radius};
        return b3OverlapMesh(&shape, identity, &proxy) ? 1.0f : 0.0f;
    };
    const auto sweep = [own](const b3Vec3* points, std::size_t count, float radius, const Vec3& way) {
        const b3Mesh shape = own->get();
        const b3ShapeCastInput query = {{points, static_cast<int>(count), radius}, to_box3d(way), 1.0f, false};
        return b3ShapeCastMesh(&shape, &query).fraction;
    };
    system[Asked::overlaps_sphere] = [overlaps](const Body& body) {
        const b3Vec3 center = to_box3d(body.near.sphere.center);
        return overlaps(&center, 1, body.near.sphere.radius);
    };
    system[Asked::overlaps_capsule] = [overlaps](const Body& body) {
        return overlaps(ends_of(body.near.capsule).data(), 2, body.near.capsule.radius);
    };
    system[Asked::overlaps_box] = [overlaps](const Body& body) {
        return overlaps(corners_of(body.near.box).data(), 8, 0.0f);
    };
    system[Asked::triangles_in_box] = [own](const Body& body) {
        float corners = 0.0f;
        std::size_t count = 0;
        visit_triangles(own->get(), {to_box3d(body.near.bounds.min), to_box3d(body.near.bounds.max)},
                        [&](const b3Vec3* corner) {
                            corners += corner[0].x + corner[1].y + corner[2].z;
                            ++count;
                        });
        return std::isnan(corners) ? -1.0f : static_cast<float>(count);
    };
    system[Asked::planes] = [own](const Body& body) {
        const auto [from, to] = ends_of(body.near.capsule);
        const b3Capsule mover = {from, to, body.near.capsule.radius};
        const b3Mesh shape = own->get();
        b3PlaneResult planes[most_contacts];
        return static_cast<float>(b3CollideMoverAndMesh(planes, most_contacts, &shape, &mover));
    };
    system[Asked::contacts_sphere] = [own](const Body& body) {
        const b3Sphere sphere = {to_box3d(body.near.sphere.center), body.near.sphere.radius};
        const b3AABB bounds = grown(&sphere.center, 1, sphere.radius + body.margin);
        return count_contacts(own->get(), bounds, [&](b3LocalManifold& manifold, const b3Vec3* corners) {
            b3CollideTriangleAndSphere(&manifold, 32, corners, &sphere);
        });
    };
    system[Asked::contacts_capsule] = [own](const Body& body) {
        const auto ends = ends_of(body.near.capsule);
        const b3Capsule capsule = {ends[0], ends[1], body.near.capsule.radius};
        const b3AABB bounds = grown(ends.data(), 2, capsule.radius + body.margin);
        return count_contacts(own->get(), bounds, [&](b3LocalManifold& manifold, const b3Vec3* corners) {
            b3SimplexCache cache = {};
            b3CollideTriangleAndCapsule(&manifold, 32, corners, &capsule, &cache);
        });
    };
    system[Asked::contacts_box] = [own](const Body& body) {
        std::array<float, 3> half;
        b3Vec3 axis[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const b3Vec3 along = to_box3d(body.near.box.half_axes[i]);
            half[i] = b3Length(along);
            axis[i] = b3MulSV(1.0f / half[i], along);
        }
        const b3Matrix3 turn = {axis[0], axis[1], axis[2]};
        const b3Transform at = {to_box3d(body.near.box.center), b3MakeQuatFromMatrix(&turn)};
        const b3BoxHull hull = b3MakeBoxHull(half[0], half[1], half[2]);
        const b3AABB bounds = grown(corners_of(body.near.box).data(), 8, body.margin);
        return count_contacts(own->get(), bounds, [&](b3LocalManifold& manifold, const b3Vec3* corners) {
            b3SATCache cache = {};
            b3CollideTriangleAndHull(&manifold, 32, b3InvTransformPoint(at, corners[0]),
                                     b3InvTransformPoint(at, corners[1]), b3InvTransformPoint(at, corners[2]), 0,
                                     &hull.base, &cache, true);
        });
    };
    system[Asked::sweep_sphere] = [sweep](const Body& body) {
        const b3Vec3 center = to_box3d(body.before.sphere.center);
        return sweep(&center, 1, body.before.sphere.radius, body.way);
    };
    system[Asked::sweep_capsule] = [sweep](const Body& body) {
        return sweep(ends_of(body.before.capsule).data(), 2, body.before.capsule.radius, body.way);
    };
    system[Asked::sweep_box] = [sweep](const Body& body) {
        return sweep(corners_of(body.before.box).data(), 8, 0.0f, body.way);
    };
    return system;
}

}  // namespace espalier::bench
