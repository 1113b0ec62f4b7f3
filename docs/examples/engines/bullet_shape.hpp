// A static mesh for Bullet that reads its triangles from a blob: in the place of btBvhTriangleMeshShape.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <espalier/espalier.hpp>

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

private:
    espalier::Blob blob_;
    btVector3 scaling_ = {1, 1, 1};
};
