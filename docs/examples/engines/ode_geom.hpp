// A static mesh for ODE that reads its triangles from a blob: in the place of a dTriMesh geom.
#pragma once

#include <espalier/espalier.hpp>
#include <ode/ode.h>

/// Returns a geom without a body, to be destroyed by dGeomDestroy(). It collides with spheres, capsules and boxes. The
/// blob, which must outlive the geom, is where the geom is, and turned as it is.
dGeomID create_espalier_geom(dSpaceID space, const espalier::Blob& blob);
