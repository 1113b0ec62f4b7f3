// A static mesh for Bullet that reads its triangles from a blob: in the place of btBvhTriangleMeshShape.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <espalier/espalier.hpp>

struct btCollisionObjectWrapper;

/// Triangles of a blob in flash, in a mapped file or in memory, which must outlive the shape. One metre of the blob is
/// one of the world; local scaling is not supported, place the body instead.
class EspalierShape : public btConcaveShape {
public:
    BT_DECLARE_ALIGNED_ALLOCATOR();

    explicit EspalierShape(const espalier::Blob& blob);

    void processAllTriangles(btTriangleCallback* callback, const btVector3& low, const btVector3& high) const override;
    void getAabb(const btTransform& place, btVector3& low, btVector3& high) const override;
    void setLocalScaling(const btVector3& scaling) override;
    const btVector3& getLocalScaling() const override { return scaling_; }
    /// The mesh does not move.
    void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
    const char* getName() const override { return "Espalier"; }
    const espalier::Blob& blob() const { return blob_; }

private:
    espalier::Blob blob_;
    btVector3 scaling_ = {1, 1, 1};
};

/// Turns the normal of a contact at an edge within a flat or hollow part of an EspalierShape to that of the triangle,
/// by the blob's edge flags. A contact of other shapes, or of a blob without edge flags, stays. It is a
/// gContactAddedCallback: Bullet calls it if a body has the flag CF_CUSTOM_MATERIAL_CALLBACK. Returns whether the
/// contact has changed.
bool correct_internal_edge(btManifoldPoint& contact, const btCollisionObjectWrapper* first, int first_part,
                           int first_index, const btCollisionObjectWrapper* second, int second_part, int second_index);
