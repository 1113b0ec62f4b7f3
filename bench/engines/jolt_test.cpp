// Compares the adapter for Jolt with Jolt's own mesh shape: the same rays, shapes, casts, points and triangles. Both
// round corners to a grid of their own, so answers agree within a tolerance and rarely differ at edges. And lets bodies
// come to rest.
#include <doctest/doctest.h>

#include <Jolt/Jolt.h>
#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/CollidePointResult.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/CollisionDispatch.h>
#include <Jolt/Physics/Collision/RayCast.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/ShapeCast.h>

#include "../base.hpp"
#include "jolt_world.hpp"
#include "resting.hpp"
#include "support/base/random.hpp"
#include "support/meshes/level_maker.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;

namespace {

/// A mesh as both shapes.
struct Pair {
    std::vector<std::byte> bytes;
    JPH::Ref<JPH::Shape> own, ours;
    Box bounds;

    explicit Pair(const tests::Mesh& mesh) {
        bench::start_jolt();
        const MeshView view = mesh.view();
        bytes = bake(std::span(&view, 1), {.resolution = Resolution::bits(20), .flat_angle = 5.0}).bytes;
        const Blob blob = open(bytes);
        REQUIRE(blob);
        bounds = blob.bounds();
        ours = new EspalierJoltShape(blob);
        own = bench::jolt_mesh(mesh);
    }
    [[nodiscard]] JPH::Vec3 somewhere(tests::Random& random) const {
        const auto between = [&](float a, float b) { return a + random.unit() * (b - a); };
        return {between(bounds.min.x, bounds.max.x), between(bounds.min.y, bounds.max.y),
                between(bounds.min.z, bounds.max.z)};
    }
};

const JPH::SubShapeIDCreator no_id;
const JPH::Vec3 scales[] = {{1.0f, 1.0f, 1.0f}, {2.0f, 2.0f, 2.0f}, {1.0f, 0.5f, 2.0f}, {-1.0f, 1.0f, 1.0f}};

struct Agreement {
    unsigned both = 0, differ = 0, neither = 0;

    void add(bool own, bool ours, bool same) {
        if (!own && !ours) ++neither;
        else if (own && ours && same) ++both;
        else ++differ;
    }
    void check(unsigned least_hits) const {
        MESSAGE(both, " agree, ", differ, " differ, ", neither, " miss");
        CHECK(both > least_hits);
        CHECK(differ <= 2 + (both + neither) / 200);
    }
};

JPH::Ref<JPH::Shape> shape_of(const bench::RestingBody& body) {
    using Kind = bench::RestingBody::Kind;
    const auto& [x, y, z] = bench::RestingBody::half;
    switch (body.kind) {
        case Kind::sphere:
            return new JPH::SphereShape(bench::RestingBody::low);
        case Kind::capsule:
            return new JPH::CapsuleShape(0.3f, bench::RestingBody::low);
        case Kind::crate:
            return new JPH::BoxShape({x, y, z}, 0.01f);
        case Kind::hull:
            break;
    }
    JPH::Array<JPH::Vec3> corners;
    for (const Vec3& corner : bench::RestingBody::hull()) corners.push_back({corner.x, corner.y, corner.z});
    return JPH::ConvexHullShapeSettings(corners, 0.01f).Create().Get();
}

/// Returns the most energy that a body has within a second above what it begins with.
float energy_gained(const bench::RestingFloor& floor, const bench::RestingBody& given) {
    bench::JoltWorld world;
    for (const Blob& blob : floor.blobs) world.add_ground(new EspalierJoltShape(blob), 0.6f);
    const auto about = [](const JPH::Vec3& axis, float angle) { return JPH::Quat::sRotation(axis, angle); };
    JPH::Quat rotation = about(-JPH::Vec3::sAxisY(), given.angle) * about(JPH::Vec3::sAxisZ(), given.turn);
    if (given.kind == bench::RestingBody::Kind::capsule)  // along y in Jolt
        rotation = rotation * about(JPH::Vec3::sAxisZ(), 0.5f * JPH::JPH_PI);
    const JPH::BodyID body = world.add_body(shape_of(given), given.middle, rotation, 0.6f);
    world.optimise();
    const JPH::BodyInterface& bodies = world.bodies();
    const auto energy = [&] {
        const JPH::Vec3 speed = bodies.GetLinearVelocity(body), spin = bodies.GetAngularVelocity(body);
        const JPH::Mat44 inertia = bodies.GetInverseInertia(body).Inversed3x3();
        return 0.5f * speed.LengthSq() + 0.5f * spin.Dot(inertia.Multiply3x3(spin)) +
               9.81f * bodies.GetCenterOfMassPosition(body).GetZ();
    };
    const float before = energy();
    float most = before;
    for (int step = 0; step < 60; ++step) {
        world.step(1.0f / 60);
        if (!bodies.IsActive(body)) break;
        most = std::max(most, energy());
    }
    return most - before;
}

}  // namespace

TEST_SUITE("jolt") {
    TEST_CASE("engine: in Jolt no body on a level or sloped floor gains speed") {
        using Kind = bench::RestingBody::Kind;
        // Jolt pushes a body out by a fifth of its depth in each step.
        bench::check_bodies_rest({Kind::sphere, Kind::capsule, Kind::crate, Kind::hull}, 0.2f * 60, energy_gained);
    }

    TEST_CASE("engine: rays and points in Jolt agree with its own mesh") {
        const Pair pair(tests::make_icosphere(4, 1.0, {}));
        tests::Random random(1);
        Agreement rays, insides;
        for (unsigned i = 0; i < 4000; ++i) {
            const JPH::RayCast ray(2.0f * pair.somewhere(random), 2.0f * pair.somewhere(random));
            JPH::RayCastResult own, ours;
            const bool own_hits = pair.own->CastRay(ray, no_id, own), our_hits = pair.ours->CastRay(ray, no_id, ours);
            rays.add(own_hits, our_hits, std::fabs(own.mFraction - ours.mFraction) < 1e-3f);
            if (own_hits && our_hits) {
                const JPH::Vec3 at = ray.GetPointOnRay(ours.mFraction);
                CHECK(pair.ours->GetSurfaceNormal(ours.mSubShapeID2, at).Dot(at) > 0.0f);
            }
            JPH::AllHitCollisionCollector<JPH::CastRayCollector> own_all, our_all;
            JPH::RayCastSettings settings;
            settings.SetBackFaceMode(i % 2 == 0 ? JPH::EBackFaceMode::CollideWithBackFaces
                                                : JPH::EBackFaceMode::IgnoreBackFaces);
            pair.own->CastRay(ray, settings, no_id, own_all);
            pair.ours->CastRay(ray, settings, no_id, our_all);
            rays.add(!own_all.mHits.empty(), !our_all.mHits.empty(), own_all.mHits.size() == our_all.mHits.size());
            JPH::AnyHitCollisionCollector<JPH::CollidePointCollector> own_inside, our_inside;
            const JPH::Vec3 point = 1.2f * pair.somewhere(random);
            pair.own->CollidePoint(point, no_id, own_inside);
            pair.ours->CollidePoint(point, no_id, our_inside);
            insides.add(own_inside.HadHit(), our_inside.HadHit(), true);
        }
        rays.check(500);
        insides.check(1000);
    }

    TEST_CASE("engine: shapes and their casts in Jolt agree with its own mesh") {
        const Pair pair(tests::make_level(4000, 3));
        tests::Random random(2);
        Agreement touching, casts;
        for (unsigned i = 0; i < 4000; ++i) {
            const JPH::Vec3 scale = scales[i / 2 % std::size(scales)];
            const JPH::Ref<JPH::Shape> body = i % 2 == 0 ? static_cast<JPH::Shape*>(new JPH::SphereShape(0.5f))
                                                         : new JPH::BoxShape({0.5f, 0.4f, 0.3f});
            const JPH::Mat44 place = JPH::Mat44::sTranslation(scale * pair.somewhere(random));
            JPH::CollideShapeSettings settings;
            settings.mMaxSeparationDistance = 0.1f;
            JPH::AllHitCollisionCollector<JPH::CollideShapeCollector> own, ours;
            const auto collide = [&](const JPH::Shape* mesh, JPH::CollideShapeCollector& collector) {
                JPH::CollisionDispatch::sCollideShapeVsShape(body, mesh, JPH::Vec3::sOne(), scale, place,
                                                             JPH::Mat44::sIdentity(), no_id, no_id, settings,
                                                             collector);
            };
            collide(pair.own, own);
            collide(pair.ours, ours);
            const auto depth = [](const auto& collector) {
                float sum = 0.0f;
                for (const JPH::CollideShapeResult& hit : collector.mHits) sum = std::max(sum, hit.mPenetrationDepth);
                return sum;
            };
            touching.add(!own.mHits.empty(), !ours.mHits.empty(), std::fabs(depth(own) - depth(ours)) < 1e-2f);

            const JPH::Vec3 way = 3.0f * JPH::Vec3(random.unit() - 0.5f, random.unit() - 0.5f, -random.unit());
            const JPH::ShapeCast cast(body, JPH::Vec3::sOne(), place, way);
            JPH::ClosestHitCollisionCollector<JPH::CastShapeCollector> own_first, our_first;
            const JPH::ShapeCastSettings cast_settings;
            const auto sweep = [&](const JPH::Shape* mesh, JPH::CastShapeCollector& collector) {
                JPH::CollisionDispatch::sCastShapeVsShapeLocalSpace(cast, cast_settings, mesh, scale, {},
                                                                    JPH::Mat44::sIdentity(), no_id, no_id, collector);
            };
            sweep(pair.own, own_first);
            sweep(pair.ours, our_first);
            casts.add(own_first.HadHit(), our_first.HadHit(),
                      own_first.HadHit() && std::fabs(own_first.mHit.mFraction - our_first.mHit.mFraction) < 1e-2f);
        }
        touching.check(500);
        casts.check(500);
    }

    TEST_CASE("engine: the list of triangles in Jolt covers the same area") {
        const Pair pair(tests::make_level(4000, 3));
        for (const JPH::Vec3& scale : scales) {
            const JPH::Quat turn = JPH::Quat::sRotation(JPH::Vec3::sAxisY(), 0.3f);
            const JPH::Vec3 place(1.0f, 2.0f, 3.0f);
            const auto area = [&](const JPH::Shape* mesh) {
                JPH::AABox everything(JPH::Vec3::sReplicate(-1e4f), JPH::Vec3::sReplicate(1e4f));
                JPH::Shape::GetTrianglesContext context;
                mesh->GetTrianglesStart(context, everything, place, turn, scale);
                double sum = 0.0, flux = 0.0;
                JPH::Float3 vertices[3 * 100];
                const JPH::PhysicsMaterial* materials[100];
                for (int count = 1; count != 0;) {
                    count = mesh->GetTrianglesNext(context, 100, vertices, materials);
                    for (int i = 0; i < count; ++i) {
                        const JPH::Vec3 a(vertices[3 * i]), b(vertices[3 * i + 1]), c(vertices[3 * i + 2]);
                        sum += static_cast<double>((b - a).Cross(c - a).Length());
                        flux += static_cast<double>((b - a).Cross(c - a).Dot({0.3f, 0.5f, 0.8f}));
                    }
                }
                return std::pair(sum, flux);
            };
            const auto [own, own_flux] = area(pair.own);
            const auto [ours, our_flux] = area(pair.ours);
            CHECK(ours == doctest::Approx(own).epsilon(1e-4));
            CHECK(our_flux == doctest::Approx(own_flux).epsilon(1e-3));
        }
    }
}
