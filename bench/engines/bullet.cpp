// The drop in Bullet.
#include <btBulletDynamicsCommon.h>

#include <engines/bullet_shape.hpp>

#include "../peers/bullet.hpp"
#include "bullet_world.hpp"
#include "drop.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::bench {

Drop drop_in_bullet(const tests::Mesh& mesh, const Blob& blob);

namespace {

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

    btTriangleIndexVertexArray triangles = bullet_arrays(mesh);
    std::unique_ptr<btConcaveShape> level;
    if (blob) {
        level = std::make_unique<EspalierShape>(blob);
        result.bytes = blob.size();
    } else {
        auto own = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
        result.bytes = bullet_bytes(*own, mesh);
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
