#include "bullet_sweeps.hpp"

#include <btBulletCollisionCommon.h>

namespace espalier::bench {

struct BulletSweeps::World {
    explicit World(const Mesh& mesh)
        : arrays(static_cast<int>(mesh.triangles.size()),
                 // Bullet takes pointers to mutable data and does not write through them.
                 reinterpret_cast<int*>(const_cast<TriangleVertices*>(mesh.triangles.data())), sizeof(TriangleVertices),
                 static_cast<int>(mesh.positions.size()),
                 reinterpret_cast<btScalar*>(const_cast<Vec3*>(mesh.positions.data())), sizeof(Vec3)),
          shape(&arrays, true) {
        body.setCollisionShape(&shape);
        body.setWorldTransform(btTransform::getIdentity());
    }

    btTriangleIndexVertexArray arrays;
    btBvhTriangleMeshShape shape;
    btCollisionObject body;
    struct Moving {
        std::unique_ptr<btConvexShape> shape;
        btMatrix3x3 rotation;
    };
    std::vector<Moving> moving;
};

BulletSweeps::BulletSweeps(const Mesh& mesh) : world_(std::make_unique<World>(mesh)) {}
BulletSweeps::~BulletSweeps() = default;

void BulletSweeps::add_hull(std::span<const Vec3> vertices) {
    static_assert(sizeof(btScalar) == sizeof(float));
    world_->moving.push_back({std::make_unique<btConvexHullShape>(reinterpret_cast<const btScalar*>(vertices.data()),
                                                                  static_cast<int>(vertices.size()), sizeof(Vec3)),
                              btMatrix3x3::getIdentity()});
    world_->moving.back().shape->setMargin(0.0f);
}

void BulletSweeps::add_box(const OrientedBox& box) {
    const auto vector = [](const Vec3& v) { return btVector3(v.x, v.y, v.z); };
    const btVector3 x = vector(box.half_axes[0]), y = vector(box.half_axes[1]), z = vector(box.half_axes[2]);
    const btVector3 a = x.normalized(), b = y.normalized(), c = z.normalized();
    world_->moving.push_back({std::make_unique<btBoxShape>(btVector3(x.length(), y.length(), z.length())),
                              btMatrix3x3(a.x(), b.x(), c.x(), a.y(), b.y(), c.y(), a.z(), b.z(), c.z())});
    world_->moving.back().shape->setMargin(0.0f);
}

float BulletSweeps::first_contact(std::size_t shape, Vec3 start, Vec3 way) const {
    const btVector3 from(start.x, start.y, start.z), to(start.x + way.x, start.y + way.y, start.z + way.z);
    btCollisionWorld::ClosestConvexResultCallback callback(from, to);
    const World::Moving& moving = world_->moving[shape];
    btCollisionWorld::objectQuerySingle(moving.shape.get(), btTransform(moving.rotation, from),
                                        btTransform(moving.rotation, to), &world_->body, &world_->shape,
                                        world_->body.getWorldTransform(), callback, 0.0f);
    return callback.m_closestHitFraction;
}

}  // namespace espalier::bench
