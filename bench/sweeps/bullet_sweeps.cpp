#include "sweeps.hpp"

#include "../peers/bullet.hpp"

namespace espalier::bench {
namespace {

struct World {
    explicit World(const Mesh& mesh) : arrays(bullet_arrays(mesh)), shape(&arrays, true) {
        body.setCollisionShape(&shape);
        body.setWorldTransform(btTransform::getIdentity());
    }
    void add(const Moving& from) {
        rotations.push_back(btMatrix3x3::getIdentity());
        if (from.local.size() == 8) {
            const auto vector = [](const Vec3& v) { return btVector3(v.x, v.y, v.z); };
            const btVector3 x = vector(from.box.half_axes[0]), y = vector(from.box.half_axes[1]),
                            z = vector(from.box.half_axes[2]);
            const btVector3 a = x.normalized(), b = y.normalized(), c = z.normalized();
            rotations.back().setValue(a.x(), b.x(), c.x(), a.y(), b.y(), c.y(), a.z(), b.z(), c.z());
            shapes.push_back(std::make_unique<btBoxShape>(btVector3(x.length(), y.length(), z.length())));
        } else {
            shapes.push_back(std::make_unique<btConvexHullShape>(reinterpret_cast<const btScalar*>(from.local.data()),
                                                                 static_cast<int>(from.local.size()),
                                                                 int{sizeof(Vec3)}));
        }
        shapes.back()->setMargin(0.0f);
    }
    [[nodiscard]] float first_contact(std::size_t i, Vec3 start, Vec3 way) const {
        const btVector3 from(start.x, start.y, start.z), to(start.x + way.x, start.y + way.y, start.z + way.z);
        btCollisionWorld::ClosestConvexResultCallback callback(from, to);
        btCollisionWorld::objectQuerySingle(shapes[i].get(), btTransform(rotations[i], from),
                                            btTransform(rotations[i], to), const_cast<btCollisionObject*>(&body),
                                            &shape, body.getWorldTransform(), callback, 0.0f);
        return callback.m_closestHitFraction;
    }

    btTriangleIndexVertexArray arrays;
    btBvhTriangleMeshShape shape;
    btCollisionObject body;
    std::vector<std::unique_ptr<btConvexShape>> shapes;
    std::vector<btMatrix3x3> rotations;
};

}  // namespace

Sweeps bullet_sweeps(const Mesh& mesh, std::span<const Moving> shapes) {
    const auto world = std::make_shared<World>(mesh);
    for (const Moving& moving : shapes) world->add(moving);
    return [world](std::span<const Moving> all, std::span<float> contacts) {
        for (std::size_t i = 0; i < all.size(); ++i) contacts[i] = world->first_contact(i, all[i].start, all[i].way);
    };
}

}  // namespace espalier::bench
