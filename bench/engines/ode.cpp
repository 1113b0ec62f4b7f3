// The drop in ODE.

#include <engines/ode_geom.hpp>

#include "../ode.hpp"
#include "drop.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::bench {

Drop drop_in_ode(const tests::Mesh& mesh, const Blob& blob);

namespace {

struct World {
    dWorldID world = dWorldCreate();
    dSpaceID space = dHashSpaceCreate(nullptr);
    dJointGroupID contacts = dJointGroupCreate(0);

    World() {
        dWorldSetGravity(world, 0, 0, -9.81);
        dWorldSetERP(world, 0.4);
        dWorldSetCFM(world, 1e-5);
        dWorldSetContactSurfaceLayer(world, 0.001);
        dWorldSetContactMaxCorrectingVel(world, 2);
        dWorldSetAutoDisableFlag(world, 1);
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
    auto& world = *static_cast<World*>(data);
    dContact contacts[8] = {};
    const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
        contacts[i].surface.mode = dContactApprox1;
        contacts[i].surface.mu = 0.8;
        dJointAttach(dJointCreateContact(world.world, world.contacts, &contacts[i]), dGeomGetBody(a), dGeomGetBody(b));
    }
}

dGeomID geom_of(const Body& body, dSpaceID space, dMass& mass) {
    const auto size = static_cast<dReal>(body.size);
    switch (body.kind) {
        case Body::Kind::sphere:
            dMassSetSphereTotal(&mass, 1, size);
            return dCreateSphere(space, size);
        case Body::Kind::box:
            dMassSetBoxTotal(&mass, 1, 2 * size, 1.4 * size, size);
            return dCreateBox(space, 2 * size, 1.4 * size, size);
        case Body::Kind::capsule:
            break;
    }
    dMassSetCapsuleTotal(&mass, 1, 3, size / 2, size);
    return dCreateCapsule(space, size / 2, size);
}

}  // namespace

Drop drop_in_ode(const tests::Mesh& mesh, const Blob& blob) {
    start_ode();
    Drop result;
    World world;
    dTriMeshDataID data = nullptr;
    if (blob) {
        create_espalier_geom(world.space, blob);
        result.bytes = blob.size();
    } else {
        data = ode_data(mesh);
        dCreateTriMesh(world.space, data, nullptr, nullptr, nullptr);
        // Its tree is OPCODE's: a node of 20 bytes a triangle, besides the arrays.
        result.bytes = mesh.positions.size() * sizeof(Vec3) + mesh.triangles.size() * (sizeof(TriangleVertices) + 20);
    }
    std::vector<dBodyID> bodies;
    for (const Body& body : make_bodies(mesh)) {
        dMass mass;
        const dGeomID geom = geom_of(body, world.space, mass);
        bodies.push_back(dBodyCreate(world.world));
        dBodySetMass(bodies.back(), &mass);
        dGeomSetBody(geom, bodies.back());
        dBodySetPosition(bodies.back(), static_cast<dReal>(body.place.x), static_cast<dReal>(body.place.y),
                         static_cast<dReal>(body.place.z));
    }
    const Stopwatch watch;
    for (unsigned step = 0; step < step_count; ++step) {
        dSpaceCollide(world.space, &world, &join);
        dWorldQuickStep(world.world, static_cast<dReal>(step_seconds));
        dJointGroupEmpty(world.contacts);
    }
    result.ms_per_step = 1000.0 * watch.seconds() / step_count;
    for (const dBodyID body : bodies) {
        const dReal *at = dBodyGetPosition(body), *way = dBodyGetLinearVel(body);
        add_rest(result, {at[0], at[1], at[2]}, std::hypot(way[0], way[1], way[2]));
    }
    if (data != nullptr) dGeomTriMeshDataDestroy(data);
    return result;
}

}  // namespace espalier::bench
