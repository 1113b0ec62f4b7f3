// The drop in ODE.

#include "drop.hpp"
#include "ode_world.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::bench {

Drop drop_in_ode(const tests::Mesh& mesh, const Blob& blob);

namespace {

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
    Drop result;
    OdeWorld world(0.8);
    dWorldSetERP(world.world(), 0.4);
    dWorldSetCFM(world.world(), 1e-5);
    dWorldSetContactSurfaceLayer(world.world(), 0.001);
    dWorldSetContactMaxCorrectingVel(world.world(), 2);
    dWorldSetAutoDisableFlag(world.world(), 1);
    dTriMeshDataID data = nullptr;
    if (blob) {
        create_espalier_geom(world.space(), blob);
        result.bytes = blob.size();
    } else {
        data = ode_data(mesh);
        dCreateTriMesh(world.space(), data, nullptr, nullptr, nullptr);
        // Its tree is OPCODE's: a node of 20 bytes a triangle, besides the arrays.
        result.bytes = mesh.positions.size() * sizeof(Vec3) + mesh.triangles.size() * (sizeof(TriangleVertices) + 20);
    }
    std::vector<dBodyID> bodies;
    for (const Body& body : make_bodies(mesh)) {
        dMass mass;
        const dGeomID geom = geom_of(body, world.space(), mass);
        bodies.push_back(world.add_body(geom, mass, body.place));
    }
    const Stopwatch watch;
    for (unsigned step = 0; step < step_count; ++step) world.step(dWorldQuickStep, static_cast<dReal>(step_seconds));
    result.ms_per_step = 1000.0 * watch.seconds() / step_count;
    for (const dBodyID body : bodies) {
        const dReal *at = dBodyGetPosition(body), *way = dBodyGetLinearVel(body);
        add_rest(result, {at[0], at[1], at[2]}, std::hypot(way[0], way[1], way[2]));
    }
    if (data != nullptr) dGeomTriMeshDataDestroy(data);
    return result;
}

}  // namespace espalier::bench
