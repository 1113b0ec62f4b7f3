// A static mesh for Jolt Physics that reads its triangles from a blob: in the place of MeshShape.
#pragma once

#include <Jolt/Jolt.h>
#include <Jolt/Physics/Collision/CollideShape.h>
#include <Jolt/Physics/Collision/Shape/Shape.h>
#include <espalier/espalier.hpp>

/// Triangles of a blob in flash, in a mapped file or in memory, which must outlive the shape. The body is static. The
/// blob's edge flags are Jolt's inactive edges: bake with flat_angle, 5 degrees as Jolt's own meshes have.
///
/// Takes the shape type User1 and the sub type User1. Not supported: saving the shape (save the blob), buoyancy.
class EspalierJoltShape final : public JPH::Shape {
public:
    JPH_OVERRIDE_NEW_DELETE

    /// Registers the shape's collision functions. To be called once, after JPH::RegisterTypes().
    static void register_type();

    explicit EspalierJoltShape(const espalier::Blob& blob);

    /// Returns the triangle of the blob that a hit or a contact names by its sub shape.
    [[nodiscard]] espalier::TriangleId triangle_of(const JPH::SubShapeID& id) const;

    bool MustBeStatic() const override { return true; }
    JPH::AABox GetLocalBounds() const override;
    JPH::uint GetSubShapeIDBitsRecursive() const override { return id_bits_; }
    float GetInnerRadius() const override { return 0.0f; }
    JPH::MassProperties GetMassProperties() const override { return {}; }
    const JPH::PhysicsMaterial* GetMaterial(const JPH::SubShapeID& id) const override;
    JPH::Vec3 GetSurfaceNormal(const JPH::SubShapeID& id, JPH::Vec3Arg place) const override;
    void GetSupportingFace(const JPH::SubShapeID& id, JPH::Vec3Arg direction, JPH::Vec3Arg scale,
                           JPH::Mat44Arg transform, SupportingFace& vertices) const override;
    void GetSubmergedVolume(JPH::Mat44Arg transform, JPH::Vec3Arg scale, const JPH::Plane& surface, float& total,
                            float& submerged,
                            JPH::Vec3& center JPH_IF_DEBUG_RENDERER(, JPH::RVec3Arg base)) const override;
#ifdef JPH_DEBUG_RENDERER
    void Draw(JPH::DebugRenderer* renderer, JPH::RMat44Arg transform, JPH::Vec3Arg scale, JPH::ColorArg color,
              bool material_colors, bool wireframe) const override;
#endif
    bool CastRay(const JPH::RayCast& ray, const JPH::SubShapeIDCreator& ids, JPH::RayCastResult& hit) const override;
    void CastRay(const JPH::RayCast& ray, const JPH::RayCastSettings& settings, const JPH::SubShapeIDCreator& ids,
                 JPH::CastRayCollector& collector, const JPH::ShapeFilter& filter = {}) const override;
    void CollidePoint(JPH::Vec3Arg point, const JPH::SubShapeIDCreator& ids, JPH::CollidePointCollector& collector,
                      const JPH::ShapeFilter& filter = {}) const override;
    void CollideSoftBodyVertices(JPH::Mat44Arg transform, JPH::Vec3Arg scale,
                                 const JPH::CollideSoftBodyVertexIterator& vertices, JPH::uint count,
                                 int shape) const override;
    void GetTrianglesStart(GetTrianglesContext& context, const JPH::AABox& box, JPH::Vec3Arg place,
                           JPH::QuatArg rotation, JPH::Vec3Arg scale) const override;
    int GetTrianglesNext(GetTrianglesContext& context, int most, JPH::Float3* vertices,
                         const JPH::PhysicsMaterial** materials) const override;
    Stats GetStats() const override { return {sizeof(*this) + blob_.size(), blob_.triangle_count()}; }
    float GetVolume() const override { return 0.0f; }

private:
    struct Walk;  // of GetTrianglesStart and GetTrianglesNext

    /// Calls `visitor` with the corners of each triangle that overlaps a box of the scaled mesh, its active edges and
    /// its sub shape.
    template <class Visitor>
    void visit(const JPH::AABox& box, JPH::Vec3Arg scale, const JPH::SubShapeIDCreator& ids, Visitor&& visitor) const;
    /// Returns the active edges of a triangle as Jolt's bits.
    [[nodiscard]] JPH::uint8 active_edges(espalier::TriangleId triangle) const;

    template <class Collision>
    static void collide(const JPH::Shape* shape, const JPH::Shape* mesh, JPH::Vec3Arg scale, JPH::Vec3Arg mesh_scale,
                        JPH::Mat44Arg transform, JPH::Mat44Arg mesh_transform, const JPH::SubShapeIDCreator& ids,
                        const JPH::SubShapeIDCreator& mesh_ids, const JPH::CollideShapeSettings& settings,
                        JPH::CollideShapeCollector& collector, const JPH::ShapeFilter& filter);
    template <class Cast>
    static void cast(const JPH::ShapeCast& cast, const JPH::ShapeCastSettings& settings, const JPH::Shape* mesh,
                     JPH::Vec3Arg mesh_scale, const JPH::ShapeFilter& filter, JPH::Mat44Arg mesh_transform,
                     const JPH::SubShapeIDCreator& ids, const JPH::SubShapeIDCreator& mesh_ids,
                     JPH::CastShapeCollector& collector);

    espalier::Blob blob_;
    JPH::uint id_bits_ = 0;
};
