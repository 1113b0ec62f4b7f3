// Lets bodies come to rest in ODE, by the adapter.
#include <doctest/doctest.h>

#include "ode_world.hpp"
#include "resting.hpp"

using namespace espalier;

namespace {

constexpr dReal correction = 0.2;  ///< of a depth in each step

float energy_gained(const bench::RestingFloor& floor, const bench::RestingBody& given) {
    using Kind = bench::RestingBody::Kind;
    bench::OdeWorld world(0.6);
    dWorldSetERP(world.world(), correction);
    for (const Blob& blob : floor.blobs) create_espalier_geom(world.space(), blob);
    constexpr auto low = static_cast<dReal>(bench::RestingBody::low);
    const auto& half = bench::RestingBody::half;
    const dReal sides[3] = {2 * static_cast<dReal>(half[0]), 2 * static_cast<dReal>(half[1]),
                            2 * static_cast<dReal>(half[2])};
    dMass mass;
    dGeomID geom = nullptr;
    if (given.kind == Kind::sphere) {
        geom = dCreateSphere(world.space(), low);
        dMassSetSphereTotal(&mass, 1, low);
    } else if (given.kind == Kind::capsule) {
        geom = dCreateCapsule(world.space(), low, 0.6);
        dMassSetCapsuleTotal(&mass, 1, 3, low, 0.6);
    } else {
        geom = dCreateBox(world.space(), sides[0], sides[1], sides[2]);
        dMassSetBoxTotal(&mass, 1, sides[0], sides[1], sides[2]);
    }
    const dBodyID body = world.add_body(geom, mass, given.middle);
    dQuaternion slope, turn, upright, both, rotation;
    dQFromAxisAndAngle(slope, 0, -1, 0, static_cast<dReal>(given.angle));
    dQFromAxisAndAngle(turn, 0, 0, 1, static_cast<dReal>(given.turn));
    // A capsule of ODE lies along z.
    dQFromAxisAndAngle(upright, 0, 1, 0, given.kind == Kind::capsule ? 1.5707963267948966 : 0.0);
    dQMultiply0(both, slope, turn);
    dQMultiply0(rotation, both, upright);
    dBodySetQuaternion(body, rotation);
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
        world.step(dWorldStep, dReal(1) / 60);
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
