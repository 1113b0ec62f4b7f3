#include "bullet_shape.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <LinearMath/btAabbUtil2.h>

namespace {

using espalier::Feature;

espalier::Vec3 from_bullet(const btVector3& v) { return {float(v.x()), float(v.y()), float(v.z())}; }
btVector3 to_bullet(const espalier::Vec3& v) { return {v.x, v.y, v.z}; }

/// Returns the mesh that the triangle of a contact is of, or null.
const EspalierShape* mesh_of(const btCollisionObjectWrapper* triangle) {
    if (triangle->getCollisionShape()->getShapeType() != TRIANGLE_SHAPE_PROXYTYPE || !triangle->m_parent)
        return nullptr;
    return dynamic_cast<const EspalierShape*>(triangle->m_parent->getCollisionShape());
}

/// Returns the part of a triangle that a point is on, which Bullet does not report. Points that GJK finds are off by
/// rounding, and by the margin where the triangle has one.
Feature feature_at(const btTriangleShape& triangle, const btVector3& point) {
    btVector3 plane;
    triangle.calcNormal(plane);
    bool touches[3];  // the edges ab, bc and ca
    for (int edge = 0; edge < 3; ++edge) {
        const btVector3& from = triangle.m_vertices1[edge];
        const btVector3 along = triangle.m_vertices1[(edge + 1) % 3] - from;
        const btScalar length = along.length();
        touches[edge] = plane.cross(along).dot(point - from) <= length * (triangle.getMargin() + length / 256);
    }
    if (touches[0] && touches[2]) return Feature::vertex_a;
    if (touches[0] && touches[1]) return Feature::vertex_b;
    if (touches[1] && touches[2]) return Feature::vertex_c;
    return touches[0]   ? Feature::edge_ab
           : touches[1] ? Feature::edge_bc
           : touches[2] ? Feature::edge_ca
                        : Feature::face;
}

/// Returns the normal to use in the place of one that leads from the surface to the body, in the space of the world.
/// The body's middle decides on which side of the triangle: a normal that lies in the plane is on neither.
btVector3 corrected(const EspalierShape& mesh, const btCollisionObjectWrapper& triangle, int index,
                    const btVector3& point, const btVector3& normal, const btCollisionObjectWrapper& body) {
    const btTransform& place = triangle.getWorldTransform();
    const auto& shape = static_cast<const btTriangleShape&>(*triangle.getCollisionShape());
    const Feature feature = feature_at(shape, place.invXform(point));
    const btVector3 to_middle = body.getWorldTransform().getOrigin() - point;
    const espalier::Vec3 local = from_bullet(to_middle * place.getBasis());  // by the transpose
    const espalier::Vec3 fixed = fix_internal_edge_normal(mesh.blob(), {std::uint32_t(index)}, feature, local);
    return fixed == local ? normal : place.getBasis() * to_bullet(fixed);
}

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

bool correct_internal_edge(btManifoldPoint& contact, const btCollisionObjectWrapper* first, int, int first_index,
                           const btCollisionObjectWrapper* second, int, int second_index) {
    const btVector3 before = contact.m_normalWorldOnB;  // from the second to the first
    if (const EspalierShape* mesh = mesh_of(second)) {
        contact.m_normalWorldOnB = corrected(*mesh, *second, second_index, contact.m_positionWorldOnB, before, *first);
        contact.m_positionWorldOnB = contact.m_positionWorldOnA - contact.m_normalWorldOnB * contact.m_distance1;
        contact.m_localPointB = second->getCollisionObject()->getWorldTransform().invXform(contact.m_positionWorldOnB);
    } else if (const EspalierShape* other = mesh_of(first)) {
        contact.m_normalWorldOnB =
            -corrected(*other, *first, first_index, contact.m_positionWorldOnA, -before, *second);
        contact.m_positionWorldOnA = contact.m_positionWorldOnB + contact.m_normalWorldOnB * contact.m_distance1;
        contact.m_localPointA = first->getCollisionObject()->getWorldTransform().invXform(contact.m_positionWorldOnA);
    }
    return contact.m_normalWorldOnB != before;
}
