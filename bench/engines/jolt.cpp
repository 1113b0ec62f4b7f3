// The drop in Jolt, on one thread.
#include <Jolt/Jolt.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>

#include "drop.hpp"
#include "jolt_world.hpp"

namespace espalier::bench {

Drop drop_in_jolt(const tests::Mesh& mesh, const Blob& blob);

namespace {

JPH::Ref<JPH::Shape> shape_of(const Body& body) {
    switch (body.kind) {
        case Body::Kind::sphere:
            return new JPH::SphereShape(body.size);
        case Body::Kind::box:
            return new JPH::BoxShape({body.size, 0.7f * body.size, 0.5f * body.size}, 0.01f);
        case Body::Kind::capsule:
            break;
    }
    return new JPH::CapsuleShape(0.5f * body.size, 0.5f * body.size);
}

}  // namespace

Drop drop_in_jolt(const tests::Mesh& mesh, const Blob& blob) {
    start_jolt();
    Drop result;
    const JPH::Ref<JPH::Shape> level = blob ? new EspalierJoltShape(blob) : jolt_mesh(mesh);
    result.bytes = level->GetStats().mSizeBytes;

    JoltWorld world;
    world.add_ground(level, 0.8f);
    std::vector<JPH::BodyID> ids;
    for (const Body& body : make_bodies(mesh)) {
        const bool is_capsule = body.kind == Body::Kind::capsule;  // along y in Jolt, along z here
        const JPH::Quat turn =
            is_capsule ? JPH::Quat::sRotation(JPH::Vec3::sAxisX(), 0.5f * JPH::JPH_PI) : JPH::Quat::sIdentity();
        ids.push_back(world.add_body(shape_of(body), body.place, turn, 0.8f));
    }
    world.optimise();
    const Stopwatch watch;
    for (unsigned step = 0; step < step_count; ++step) world.step(step_seconds);
    result.ms_per_step = 1000.0 * watch.seconds() / step_count;
    const JPH::BodyInterface& bodies = world.bodies();
    for (const JPH::BodyID id : ids) {
        const JPH::RVec3 at = bodies.GetCenterOfMassPosition(id);
        add_rest(result, {double(at.GetX()), double(at.GetY()), double(at.GetZ())},
                 double(bodies.GetLinearVelocity(id).Length()));
    }
    return result;
}

}  // namespace espalier::bench
