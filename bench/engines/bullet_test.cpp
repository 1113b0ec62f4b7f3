// Slides bodies over a flat floor of many triangles in Bullet, and over a ridge, with and without the adapter's
// callback for internal edges; and lets bodies come to rest.
#include <doctest/doctest.h>

#include <deque>

#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <btBulletDynamicsCommon.h>

#include <engines/bullet_shape.hpp>

#include "../base.hpp"
#include "bullet_world.hpp"
#include "resting.hpp"
#include "support/blobs/baking.hpp"
#include "support/meshes/mesh.hpp"

using namespace espalier;

namespace {

/// A strip along x, 24 m long and 4 m wide, of triangles that lie anyhow; its height depends on x.
tests::Mesh make_strip(float (*height)(float x)) {
    constexpr std::uint32_t along = 96, across = 12;
    tests::Mesh mesh;
    for (std::uint32_t i = 0; i <= along; ++i) {
        for (std::uint32_t j = 0; j <= across; ++j) {
            const float x = -12.0f + 0.25f * static_cast<float>(i);
            mesh.positions.push_back(
                {x, -2.0f + (static_cast<float>(j) + 0.3f * static_cast<float>(i % 3)) / 3, height(x)});
        }
    }
    for (std::uint32_t i = 0; i < along; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t a = i * (across + 1) + j, b = a + across + 1;
            mesh.triangles.push_back({a, b, (i + j) % 2 == 0 ? a + 1 : b + 1});
            mesh.triangles.push_back({(i + j) % 2 == 0 ? b : a, b + 1, a + 1});
        }
    }
    return mesh;
}
float flat(float) { return 0.0f; }
/// Ridges and valleys, an edge apart.
float folded(float x) { return std::fabs(std::remainder(x, 1.0f)); }

/// The worst of what a floor does to a body that slides over it.
struct Ride {
    btScalar rise = 0;      ///< of its middle
    btScalar sideways = 0;  ///< speed across its way
    btScalar speed = 0;     ///< at the end, along its way
    int corrected = 0;      ///< contacts
};

int corrected_contacts = 0;
bool count_corrected(btManifoldPoint& contact, const btCollisionObjectWrapper* first, int first_part, int first_index,
                     const btCollisionObjectWrapper* second, int second_part, int second_index) {
    const bool is = correct_internal_edge(contact, first, first_part, first_index, second, second_part, second_index);
    corrected_contacts += is ? 1 : 0;
    return is;
}

/// Sends a body of one kilogram along x for two seconds, without friction.
Ride ride(const Blob& blob, btConvexShape& shape, btScalar height, ContactAddedCallback callback) {
    bench::BulletWorld bullet;
    btDiscreteDynamicsWorld& world = bullet.world;
    EspalierShape level(blob);
    btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &level));
    ground.setCollisionFlags(ground.getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    ground.setFriction(0);
    world.addRigidBody(&ground);
    btVector3 inertia;
    shape.calculateLocalInertia(1, inertia);
    btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &shape, inertia));
    body.setWorldTransform(btTransform(btQuaternion::getIdentity(), {-10, 0.1f, height}));
    body.setLinearVelocity({8, 0, 0});
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);

    gContactAddedCallback = callback;
    corrected_contacts = 0;
    Ride result;
    for (int step = 0; step < 120; ++step) {
        world.stepSimulation(1.0f / 60, 0);
        result.rise = std::max(result.rise, body.getWorldTransform().getOrigin().z() - height);
        result.sideways = std::max(result.sideways, btFabs(body.getLinearVelocity().y()));
    }
    result.speed = body.getLinearVelocity().x();
    result.corrected = corrected_contacts;
    gContactAddedCallback = nullptr;
    world.removeRigidBody(&body);
    world.removeRigidBody(&ground);
    return result;
}

BakeOptions with_edge_flags() { return {.flat_angle = 5.0}; }

/// A contact with an edge of a placed mesh, whose normal leans outward over the edge.
class EdgeContact {
public:
    EdgeContact(EspalierShape& mesh, const btTransform& place, TriangleId triangle, int edge) : triangle_(triangle) {
        const Triangle corners = triangle_at(mesh.blob(), triangle).value;
        const Vec3 all[3] = {corners.a, corners.b, corners.c};
        const auto corner = [&](int i) { return btVector3(all[i % 3].x, all[i % 3].y, all[i % 3].z); };
        shape_ = std::make_unique<btTriangleShape>(corner(0), corner(1), corner(2));
        shape_->calcNormal(face_);
        const btVector3 along = corner(edge + 1) - corner(edge);
        leaning_ = place.getBasis() * (face_ + along.cross(face_).normalized()).normalized();
        face_ = place.getBasis() * face_;
        point_ = place * ((corner(edge) + corner(edge + 1)) / 2);
        ground_.setCollisionShape(&mesh);
        ground_.setWorldTransform(place);
    }
    [[nodiscard]] const btVector3& face() const { return face_; }
    [[nodiscard]] const btVector3& leaning() const { return leaning_; }

    /// Returns the normal from the surface to a ball after the callback, the mesh being the second body or the first.
    [[nodiscard]] btVector3 normal(bool mesh_is_first) {
        btSphereShape ball(0.5f);
        btCollisionObject body;
        body.setCollisionShape(&ball);
        const btScalar gap = -0.125f;
        body.setWorldTransform(btTransform(btQuaternion::getIdentity(), point_ + leaning_ * (ball.getRadius() + gap)));
        const btCollisionObjectWrapper ball_wrap(nullptr, &ball, &body, body.getWorldTransform(), -1, -1);
        const btCollisionObjectWrapper mesh_wrap(nullptr, ground_.getCollisionShape(), &ground_,
                                                 ground_.getWorldTransform(), -1, -1);
        const btCollisionObjectWrapper triangle_wrap(&mesh_wrap, shape_.get(), &ground_, ground_.getWorldTransform(), 0,
                                                     static_cast<int>(triangle_.index));
        btManifoldPoint contact;
        contact.m_distance1 = gap;
        contact.m_normalWorldOnB = mesh_is_first ? -leaning_ : leaning_;
        const btVector3 on_ball = point_ + leaning_ * gap;
        contact.m_positionWorldOnA = mesh_is_first ? point_ : on_ball;
        contact.m_positionWorldOnB = mesh_is_first ? on_ball : point_;
        const btVector3 before = contact.m_normalWorldOnB;
        const int index = static_cast<int>(triangle_.index);
        const bool changed = mesh_is_first
                                 ? correct_internal_edge(contact, &triangle_wrap, 0, index, &ball_wrap, -1, -1)
                                 : correct_internal_edge(contact, &ball_wrap, -1, -1, &triangle_wrap, 0, index);
        CHECK(changed == (contact.m_normalWorldOnB != before));
        // Its numbers fit each other: the points are apart by the distance, along the normal.
        const btVector3 apart = contact.m_positionWorldOnA - contact.m_positionWorldOnB;
        CHECK((apart - contact.m_normalWorldOnB * gap).length() < 1e-5f);
        CHECK(((mesh_is_first ? contact.m_positionWorldOnB : contact.m_positionWorldOnA) - on_ball).length() < 1e-6f);
        return mesh_is_first ? -contact.m_normalWorldOnB : contact.m_normalWorldOnB;
    }

private:
    TriangleId triangle_;
    std::unique_ptr<btTriangleShape> shape_;
    btVector3 face_, leaning_, point_;
    btCollisionObject ground_;
};

std::unique_ptr<btConvexShape> shape_of(const bench::RestingBody& body) {
    using Kind = bench::RestingBody::Kind;
    const auto& [x, y, z] = bench::RestingBody::half;
    switch (body.kind) {
        case Kind::sphere:
            return std::make_unique<btSphereShape>(bench::RestingBody::low);
        case Kind::capsule:
            return std::make_unique<btCapsuleShapeX>(bench::RestingBody::low, 0.6f);
        case Kind::crate:
            return std::make_unique<btBoxShape>(btVector3(x, y, z));
        case Kind::hull:
            break;
    }
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& corner : bench::RestingBody::hull()) hull->addPoint({corner.x, corner.y, corner.z});
    hull->setMargin(0.0f);  // else it stands on its margin, above its vertices
    return hull;
}

/// Returns the most energy that a body has within a second above what it begins with.
float energy_gained(const bench::RestingFloor& floor, const bench::RestingBody& given) {
    bench::BulletWorld bullet;
    std::deque<EspalierShape> shapes;
    std::deque<btRigidBody> grounds;
    for (const Blob& blob : floor.blobs) {
        grounds.emplace_back(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shapes.emplace_back(blob)));
        grounds.back().setCollisionFlags(grounds.back().getCollisionFlags() |
                                         btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
        bullet.world.addRigidBody(&grounds.back());
    }
    const std::unique_ptr<btConvexShape> shape = shape_of(given);
    btVector3 inertia;
    shape->calculateLocalInertia(1, inertia);
    btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, shape.get(), inertia));
    const btQuaternion rotation = btQuaternion({0, -1, 0}, given.angle) * btQuaternion({0, 0, 1}, given.turn);
    body.setWorldTransform(btTransform(rotation, {given.middle.x, given.middle.y, given.middle.z}));
    body.setActivationState(DISABLE_DEACTIVATION);
    bullet.world.addRigidBody(&body);
    const auto energy = [&] {
        const btVector3 spin = body.getAngularVelocity() * body.getWorldTransform().getBasis();  // in its own axes
        return 0.5f * body.getLinearVelocity().length2() + 0.5f * (spin * spin).dot(inertia) +
               9.81f * body.getWorldTransform().getOrigin().z();
    };
    const btScalar before = energy();
    btScalar most = before;
    gContactAddedCallback = correct_internal_edge;
    for (int step = 0; step < 60; ++step) {
        bullet.world.stepSimulation(1.0f / 60, 0);
        most = std::max(most, energy());
    }
    gContactAddedCallback = nullptr;
    bullet.world.removeRigidBody(&body);
    for (btRigidBody& ground : grounds) bullet.world.removeRigidBody(&ground);
    return most - before;
}

}  // namespace

TEST_SUITE("bullet") {
    TEST_CASE("engine: in Bullet no body on a level or sloped floor gains speed with the callback") {
        using Kind = bench::RestingBody::Kind;
        // Bullet pushes a body out by a fifth of its depth in each step.
        bench::check_bodies_rest({Kind::sphere, Kind::capsule, Kind::crate, Kind::hull}, 0.2f * 60, energy_gained);
    }

    TEST_CASE("engine: in Bullet a body slides straight over a flat floor with the callback for internal edges") {
        const tests::OpenedBlob floor(make_strip(flat), with_edge_flags());
        btBoxShape box({0.3f, 0.2f, 0.15f});
        btSphereShape sphere(0.15f);
        for (btConvexShape* shape : {static_cast<btConvexShape*>(&box), static_cast<btConvexShape*>(&sphere)}) {
            CAPTURE(shape->getName());
            const Ride plain = ride(floor.blob, *shape, 0.15f, nullptr);
            CHECK(plain.rise > 0.05f);
            CHECK(plain.sideways > 0.1f);
            CHECK(plain.speed < 7.0f);
            const Ride corrected = ride(floor.blob, *shape, 0.15f, count_corrected);
            CHECK(corrected.rise < 1e-5f);
            CHECK(corrected.sideways < 2e-3f);
            CHECK(corrected.speed > 7.99f);
            CHECK(corrected.corrected > 100);
        }
    }

    TEST_CASE(
        "engine: in Bullet a contact with a ridge keeps its normal and one with a flat or hollow edge gets another") {
        const tests::OpenedBlob folds(make_strip(folded), with_edge_flags());
        EspalierShape mesh(folds.blob);
        const btTransform place(btQuaternion(btVector3(1, 2, 3).normalized(), 0.7f), {3, -2, 1});
        int corrected = 0, kept = 0;
        for (std::uint32_t number = 0; number < folds.blob.triangle_count(); ++number) {
            const TriangleId triangle{number};
            const EdgeKinds kinds = edge_kinds(folds.blob, triangle).value;
            const EdgeKind of_edge[3] = {kinds.ab, kinds.bc, kinds.ca};
            for (int edge = 0; edge < 3; ++edge) {
                EdgeContact contact(mesh, place, triangle, edge);
                const bool is_inner = of_edge[edge] == EdgeKind::flat || of_edge[edge] == EdgeKind::concave;
                ++(is_inner ? corrected : kept);
                const btVector3& expected = is_inner ? contact.face() : contact.leaning();
                for (const bool mesh_is_first : {false, true})
                    CHECK((contact.normal(mesh_is_first) - expected).length() < 1e-5f);
            }
        }
        CHECK(corrected > 1000);
        CHECK(kept > 100);
    }
}
