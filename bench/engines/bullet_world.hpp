// A world of Bullet with gravity along -z.
#pragma once

#include <btBulletDynamicsCommon.h>

namespace espalier::bench {

/// What a world of Bullet consists of, in the order in which it is built.
struct BulletWorld {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

    BulletWorld() { world.setGravity({0, 0, -9.81f}); }
    BulletWorld(const BulletWorld&) = delete;
    BulletWorld& operator=(const BulletWorld&) = delete;
};

}  // namespace espalier::bench
