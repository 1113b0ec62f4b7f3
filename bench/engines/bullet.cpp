// The drop in Bullet.
#include <btBulletDynamicsCommon.h>

#include <engines/bullet_shape.hpp>

#include "bullet_world.hpp"
#include "drop.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::bench {

Drop drop_in_bullet(const tests::Mesh& mesh, const Blob& blob);

namespace {

/// Arrays of Bullet's own shape, which it does not copy.
struct Arrays {
    std::vector<float> vertices;
    std::vector<int> indices;

    explicit Arrays(const tests::Mesh& mesh) {
        for (const Vec3& p : mesh.positions) vertices.insert(vertices.end(), {p.x, p.y, p.z});
        for (const auto& t : mesh.triangles)
            for (const std::uint32_t index : t) indices.push_back(static_cast<int>(index));
    }
    [[nodiscard]] std::size_t bytes() const { return vertices.size() * sizeof(float) + indices.size() * sizeof(int); }
};

std::unique_ptr<btCollisionShape> shape_of(const Body& body) {
    switch (body.kind) {
        case Body::Kind::sphere:
            return std::make_unique<btSphereShape>(body.size);
        case Body::Kind::box:
            return std::make_unique<btBoxShape>(btVector3(body.size, 0.7f * body.size, 0.5f * body.size));
        case Body::Kind::capsule:
            break;
    }
    return std::make_unique<btCapsuleShapeZ>(0.5f * body.size, body.size);
}

}  // namespace

Drop drop_in_bullet(const tests::Mesh& mesh, const Blob& blob) {
    Drop result;
    BulletWorld bullet;
    btDiscreteDynamicsWorld& world = bullet.world;

    Arrays arrays(mesh);
    btTriangleIndexVertexArray triangles(static_cast<int>(arrays.indices.size() / 3), arrays.indices.data(),
                                         3 * sizeof(int), static_cast<int>(arrays.vertices.size() / 3),
                                         arrays.vertices.data(), 3 * sizeof(float));
    std::unique_ptr<btConcaveShape> level;
    if (blob) {
        level = std::make_unique<EspalierShape>(blob);
        result.bytes = blob.size();
    } else {
        auto own = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
        result.bytes = arrays.bytes() + own->getOptimizedBvh()->calculateSerializeBufferSize();
        level = std::move(own);
    }
    btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, level.get()));
    ground.setFriction(0.8f);
    world.addRigidBody(&ground);

    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btDefaultMotionState>> states;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    for (const Body& body : make_bodies(mesh)) {
        shapes.push_back(shape_of(body));
        btVector3 inertia;
        shapes.back()->calculateLocalInertia(1, inertia);
        states.push_back(std::make_unique<btDefaultMotionState>(
            btTransform(btQuaternion::getIdentity(), {body.place.x, body.place.y, body.place.z})));
        btRigidBody::btRigidBodyConstructionInfo info(1, states.back().get(), shapes.back().get(), inertia);
        info.m_friction = 0.8f;
        info.m_rollingFriction = 0.02f;
        bodies.push_back(std::make_unique<btRigidBody>(info));
        world.addRigidBody(bodies.back().get());
    }
    const Stopwatch watch;
    for (unsigned step = 0; step < step_count; ++step) world.stepSimulation(step_seconds, 0);
    result.ms_per_step = 1000.0 * watch.seconds() / step_count;
    for (const auto& body : bodies) {
        const btVector3& at = body->getWorldTransform().getOrigin();
        add_rest(result, {double(at.x()), double(at.y()), double(at.z())}, double(body->getLinearVelocity().length()));
    }
    for (const auto& body : bodies) world.removeRigidBody(body.get());
    world.removeRigidBody(&ground);
    return result;
}

}  // namespace espalier::bench
