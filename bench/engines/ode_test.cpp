// Lets bodies come to rest in ODE, by the adapter.
#include <doctest/doctest.h>

#include <engines/ode_geom.hpp>

#include "../ode.hpp"
#include "resting.hpp"

using namespace espalier;

namespace {

constexpr dReal correction = 0.2;  ///< of a depth in each step

struct World {
    dWorldID world = dWorldCreate();
    dSpaceID space = dHashSpaceCreate(nullptr);
    dJointGroupID contacts = dJointGroupCreate(0);

    World() {
        dWorldSetGravity(world, 0, 0, -9.81);
        dWorldSetERP(world, correction);
    }
    ~World() {
        dJointGroupDestroy(contacts);
        dSpaceDestroy(space);
        dWorldDestroy(world);
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;
};

void join(void* data, dGeomID a, dGeomID b) {
    if (dGeomGetBody(a) == dGeomGetBody(b)) return;  // two tiles of the floor
    auto& world = *static_cast<World*>(data);
    dContact contacts[8] = {};
    const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
        contacts[i].surface.mode = dContactApprox1;
        contacts[i].surface.mu = 0.6;
        dJointAttach(dJointCreateContact(world.world, world.contacts, &contacts[i]), dGeomGetBody(a), dGeomGetBody(b));
    }
}

float energy_gained(const bench::RestingFloor& floor, const bench::RestingBody& given) {
    using Kind = bench::RestingBody::Kind;
    bench::start_ode();
    World world;
    for (const Blob& blob : floor.blobs) create_espalier_geom(world.space, blob);
    constexpr auto low = static_cast<dReal>(bench::RestingBody::low);
    const auto& half = bench::RestingBody::half;
    const dReal sides[3] = {2 * static_cast<dReal>(half[0]), 2 * static_cast<dReal>(half[1]),
                            2 * static_cast<dReal>(half[2])};
    dMass mass;
    dGeomID geom = nullptr;
    if (given.kind == Kind::sphere) {
        geom = dCreateSphere(world.space, low);
        dMassSetSphereTotal(&mass, 1, low);
    } else if (given.kind == Kind::capsule) {
        geom = dCreateCapsule(world.space, low, 0.6);
        dMassSetCapsuleTotal(&mass, 1, 3, low, 0.6);
    } else {
        geom = dCreateBox(world.space, sides[0], sides[1], sides[2]);
        dMassSetBoxTotal(&mass, 1, sides[0], sides[1], sides[2]);
    }
    const dBodyID body = dBodyCreate(world.world);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    dQuaternion slope, turn, upright, both, rotation;
    dQFromAxisAndAngle(slope, 0, -1, 0, static_cast<dReal>(given.angle));
    dQFromAxisAndAngle(turn, 0, 0, 1, static_cast<dReal>(given.turn));
    // A capsule of ODE lies along z.
    dQFromAxisAndAngle(upright, 0, 1, 0, given.kind == Kind::capsule ? 1.5707963267948966 : 0.0);
    dQMultiply0(both, slope, turn);
    dQMultiply0(rotation, both, upright);
    dBodySetQuaternion(body, rotation);
    dBodySetPosition(body, static_cast<dReal>(given.middle.x), static_cast<dReal>(given.middle.y),
                     static_cast<dReal>(given.middle.z));
    const auto energy = [&] {
        const dReal *v = dBodyGetLinearVel(body), *w = dBodyGetAngularVel(body);
        dVector3 spin;
        dBodyVectorFromWorld(body, w[0], w[1], w[2], spin);
        dReal sum = 9.81 * dBodyGetPosition(body)[2];
        for (int k = 0; k < 3; ++k) sum += (v[k] * v[k] + mass.I[5 * k] * spin[k] * spin[k]) / 2;
        return sum;
    };
    const dReal before = energy();
    dReal most = before;
    for (int step = 0; step < 60; ++step) {
        dSpaceCollide(world.space, &world, &join);
        dWorldStep(world.world, dReal(1) / 60);
        dJointGroupEmpty(world.contacts);
        most = std::max(most, energy());
    }
    return static_cast<float>(most - before);
}

}  // namespace

TEST_SUITE("ode") {
    TEST_CASE("engine: in ODE no body on a level or sloped floor gains speed") {
        using Kind = bench::RestingBody::Kind;
        bench::check_bodies_rest({Kind::sphere, Kind::capsule, Kind::crate}, static_cast<float>(correction) * 60,
                                 energy_gained);
    }
}
