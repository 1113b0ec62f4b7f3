// The drop in Jolt, on one thread.
#include <Jolt/Jolt.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSystem.h>

#include "drop.hpp"
#include "jolt_start.hpp"

namespace espalier::bench {

Drop drop_in_jolt(const tests::Mesh& mesh, const Blob& blob);

namespace {

constexpr JPH::ObjectLayer fixed = 0, movable = 1;

/// Two layers, of which the fixed one does not collide with itself.
struct Layers final : JPH::BroadPhaseLayerInterface {
    JPH::uint GetNumBroadPhaseLayers() const override { return 2; }
    JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer layer) const override {
        return JPH::BroadPhaseLayer(static_cast<JPH::BroadPhaseLayer::Type>(layer));
    }
#if defined(JPH_EXTERNAL_PROFILE) || defined(JPH_PROFILE_ENABLED)
    const char* GetBroadPhaseLayerName(JPH::BroadPhaseLayer) const override { return ""; }
#endif
};
struct LayerFilter final : JPH::ObjectVsBroadPhaseLayerFilter {
    bool ShouldCollide(JPH::ObjectLayer a, JPH::BroadPhaseLayer b) const override {
        return a == movable || b == JPH::BroadPhaseLayer(movable);
    }
};
struct PairFilter final : JPH::ObjectLayerPairFilter {
    bool ShouldCollide(JPH::ObjectLayer a, JPH::ObjectLayer b) const override { return a == movable || b == movable; }
};

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

    JPH::TempAllocatorImpl memory(32 << 20);
    JPH::JobSystemSingleThreaded jobs(JPH::cMaxPhysicsJobs);
    Layers layers;
    LayerFilter layer_filter;
    PairFilter pair_filter;
    JPH::PhysicsSystem world;
    world.Init(1024, 0, 4096, 4096, layers, layer_filter, pair_filter);
    world.SetGravity({0.0f, 0.0f, -9.81f});
    JPH::BodyInterface& bodies = world.GetBodyInterfaceNoLock();
    JPH::BodyCreationSettings ground(level, JPH::RVec3::sZero(), JPH::Quat::sIdentity(), JPH::EMotionType::Static,
                                     fixed);
    ground.mFriction = 0.8f;
    bodies.CreateAndAddBody(ground, JPH::EActivation::DontActivate);
    std::vector<JPH::BodyID> ids;
    for (const Body& body : make_bodies(mesh)) {
        const bool is_capsule = body.kind == Body::Kind::capsule;  // along y in Jolt, along z here
        const JPH::Quat turn =
            is_capsule ? JPH::Quat::sRotation(JPH::Vec3::sAxisX(), 0.5f * JPH::JPH_PI) : JPH::Quat::sIdentity();
        JPH::BodyCreationSettings settings(shape_of(body), {body.place.x, body.place.y, body.place.z}, turn,
                                           JPH::EMotionType::Dynamic, movable);
        settings.mFriction = 0.8f;
        settings.mOverrideMassProperties = JPH::EOverrideMassProperties::CalculateInertia;
        settings.mMassPropertiesOverride.mMass = 1.0f;
        ids.push_back(bodies.CreateAndAddBody(settings, JPH::EActivation::Activate));
    }
    world.OptimizeBroadPhase();
    const Stopwatch watch;
    for (unsigned step = 0; step < step_count; ++step) world.Update(step_seconds, 1, &memory, &jobs);
    result.ms_per_step = 1000.0 * watch.seconds() / step_count;
    for (const JPH::BodyID id : ids) {
        const JPH::RVec3 at = bodies.GetCenterOfMassPosition(id);
        add_rest(result, {double(at.GetX()), double(at.GetY()), double(at.GetZ())},
                 double(bodies.GetLinearVelocity(id).Length()));
    }
    return result;
}

}  // namespace espalier::bench
