// A world of ODE with gravity along -z.
#pragma once

#include <engines/ode_geom.hpp>

#include "../peers/ode.hpp"

namespace espalier::bench {

/// Bodies, their geometries and the contacts of a step.
class OdeWorld {
public:
    explicit OdeWorld(dReal friction) : friction_(friction) { dWorldSetGravity(world_, 0, 0, -9.81); }
    ~OdeWorld() {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    OdeWorld(const OdeWorld&) = delete;
    OdeWorld& operator=(const OdeWorld&) = delete;

    [[nodiscard]] dWorldID world() const { return world_; }
    [[nodiscard]] dSpaceID space() const { return space_; }

    /// Makes a body of a geometry in the space.
    [[nodiscard]] dBodyID add_body(dGeomID geometry, const dMass& mass, const Vec3& place) const {
        const dBodyID body = dBodyCreate(world_);
        dBodySetMass(body, &mass);
        dGeomSetBody(geometry, body);
        dBodySetPosition(body, static_cast<dReal>(place.x), static_cast<dReal>(place.y), static_cast<dReal>(place.z));
        return body;
    }
    /// `solve` is a step function of ODE.
    template <class Solve>
    void step(Solve solve, dReal seconds) {
        dSpaceCollide(space_, this, &join);
        solve(world_, seconds);
        dJointGroupEmpty(contacts_);
    }

private:
    /// Starts the library before the members that it makes.
    struct Started {
        Started() { start_ode(); }
    };
    static void join(void* data, dGeomID a, dGeomID b) {
        if (dGeomGetBody(a) == dGeomGetBody(b)) return;  // two tiles of the floor
        const auto& self = *static_cast<const OdeWorld*>(data);
        dContact contacts[8] = {};
        const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = self.friction_;
            dJointAttach(dJointCreateContact(self.world_, self.contacts_, &contacts[i]), dGeomGetBody(a),
                         dGeomGetBody(b));
        }
    }

    Started started_;
    dWorldID world_ = dWorldCreate();
    dSpaceID space_ = dHashSpaceCreate(nullptr);
    dJointGroupID contacts_ = dJointGroupCreate(0);
    dReal friction_;
};

}  // namespace espalier::bench
