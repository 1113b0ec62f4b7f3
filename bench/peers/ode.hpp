// ODE as every benchmark has it. Compiled where ODE is installed.
#pragma once

#include <cstdarg>

#include <ode/ode.h>

#include "../base.hpp"

namespace espalier::bench {

/// Starts the library with the first call, and ends it with the process.
inline void start_ode() {
    struct Library {
        Library() {
            dInitODE2(0);
            // It has a line to say for each contact that its table has no place for: not while it is measured.
            dSetMessageHandler([](int, const char*, va_list) {});
        }
        ~Library() { dCloseODE(); }
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };
    static const Library library;
}

/// Returns the tree over a mesh, whose arrays ODE reads in place.
inline dTriMeshDataID ode_data(const Mesh& mesh) {
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(data, mesh.positions.data(), sizeof(Vec3), static_cast<int>(mesh.positions.size()),
                                mesh.triangles.data(), static_cast<int>(3 * mesh.triangles.size()),
                                sizeof(TriangleVertices));
    return data;
}

}  // namespace espalier::bench
