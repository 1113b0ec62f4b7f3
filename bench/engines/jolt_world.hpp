// A world of Jolt with gravity along -z, on one thread.
#pragma once

#include <Jolt/Jolt.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/PhysicsSystem.h>

#include "jolt_start.hpp"

namespace espalier::bench {

/// A world with a layer for what stays, which does not collide with itself, and one for what moves.
class JoltWorld {
public:
    JoltWorld() {
        system_.Init(1024, 0, 4096, 4096, layers_, layer_filter_, pair_filter_);
        system_.SetGravity({0.0f, 0.0f, -9.81f});
    }

    void add_ground(const JPH::Shape* shape, float friction) {
        JPH::BodyCreationSettings ground(shape, JPH::RVec3::sZero(), JPH::Quat::sIdentity(), JPH::EMotionType::Static,
                                         fixed);
        ground.mFriction = friction;
        bodies().CreateAndAddBody(ground, JPH::EActivation::DontActivate);
    }
    /// Adds a body of one kilogram.
    JPH::BodyID add_body(const JPH::Shape* shape, const Vec3& place, const JPH::Quat& rotation, float friction) {
        JPH::BodyCreationSettings settings(shape, {place.x, place.y, place.z}, rotation, JPH::EMotionType::Dynamic,
                                           movable);
        settings.mFriction = friction;
        settings.mOverrideMassProperties = JPH::EOverrideMassProperties::CalculateInertia;
        settings.mMassPropertiesOverride.mMass = 1.0f;
        return bodies().CreateAndAddBody(settings, JPH::EActivation::Activate);
    }
    [[nodiscard]] JPH::BodyInterface& bodies() { return system_.GetBodyInterfaceNoLock(); }
    void optimise() { system_.OptimizeBroadPhase(); }
    void step(float seconds) { system_.Update(seconds, 1, &memory_, &jobs_); }

private:
    static constexpr JPH::ObjectLayer fixed = 0, movable = 1;

    struct Layers final : JPH::BroadPhaseLayerInterface {
        [[nodiscard]] JPH::uint GetNumBroadPhaseLayers() const override { return 2; }
        [[nodiscard]] JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer layer) const override {
            return JPH::BroadPhaseLayer(static_cast<JPH::BroadPhaseLayer::Type>(layer));
        }
#if defined(JPH_EXTERNAL_PROFILE) || defined(JPH_PROFILE_ENABLED)
        const char* GetBroadPhaseLayerName(JPH::BroadPhaseLayer) const override { return ""; }
#endif
    };
    struct LayerFilter final : JPH::ObjectVsBroadPhaseLayerFilter {
        [[nodiscard]] bool ShouldCollide(JPH::ObjectLayer a, JPH::BroadPhaseLayer b) const override {
            return a == movable || b == JPH::BroadPhaseLayer(movable);
        }
    };
    struct PairFilter final : JPH::ObjectLayerPairFilter {
        [[nodiscard]] bool ShouldCollide(JPH::ObjectLayer a, JPH::ObjectLayer b) const override {
            return a == movable || b == movable;
        }
    };
    /// Comes before the members that Jolt's allocator makes.
    struct Started {
        Started() { start_jolt(); }
    };

    Started started_;
    JPH::TempAllocatorImpl memory_{32 << 20};
    JPH::JobSystemSingleThreaded jobs_{JPH::cMaxPhysicsJobs};
    Layers layers_;
    LayerFilter layer_filter_;
    PairFilter pair_filter_;
    JPH::PhysicsSystem system_;
};

}  // namespace espalier::bench
