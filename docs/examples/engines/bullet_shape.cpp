#include "bullet_shape.hpp"

#include <LinearMath/btAabbUtil2.h>

namespace {

espalier::Vec3 from_bullet(const btVector3& v) { return {float(v.x()), float(v.y()), float(v.z())}; }
btVector3 to_bullet(const espalier::Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

// Bullet casts CUSTOM_CONCAVE_SHAPE_TYPE to a type of its own, and crashes; this type it takes as it is.
EspalierShape::EspalierShape(const espalier::Blob& blob) : blob_(blob) { m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE; }

void EspalierShape::processAllTriangles(btTriangleCallback* callback, const btVector3& low,
                                        const btVector3& high) const {
    const espalier::Box box = {from_bullet(low), from_bullet(high)};
    const auto status =
        for_each_overlap(blob_, box, [&](espalier::TriangleId triangle, const espalier::Triangle& corners) {
            btVector3 vertices[3] = {to_bullet(corners.a), to_bullet(corners.b), to_bullet(corners.c)};
            callback->processTriangle(vertices, 0, int(triangle.index));
        });
    (void)status;  // a refusal, of a NaN, has no triangles
}

void EspalierShape::getAabb(const btTransform& place, btVector3& low, btVector3& high) const {
    const espalier::Box box = blob_.bounds();
    btTransformAabb(to_bullet(box.min), to_bullet(box.max), getMargin(), place, low, high);
}

void EspalierShape::setLocalScaling(const btVector3& scaling) {
    btAssert(scaling == scaling_);
    (void)scaling;
}

void EspalierShape::calculateLocalInertia(btScalar, btVector3& inertia) const { inertia.setZero(); }
