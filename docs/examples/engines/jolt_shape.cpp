#include "jolt_shape.hpp"

#include <Jolt/Geometry/OrientedBox.h>
#include <Jolt/Physics/Collision/CastConvexVsTriangles.h>
#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/CastSphereVsTriangles.h>
#include <Jolt/Physics/Collision/CollideConvexVsTriangles.h>
#include <Jolt/Physics/Collision/CollidePointResult.h>
#include <Jolt/Physics/Collision/CollideSphereVsTriangles.h>
#include <Jolt/Physics/Collision/CollisionDispatch.h>
#include <Jolt/Physics/Collision/PhysicsMaterial.h>
#include <Jolt/Physics/Collision/RayCast.h>
#include <Jolt/Physics/Collision/Shape/ConvexShape.h>
#include <Jolt/Physics/Collision/Shape/ScaleHelpers.h>  // before the next, which lacks it
#include <Jolt/Physics/Collision/CollideSoftBodyVerticesVsTriangles.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/ShapeCast.h>
#include <Jolt/Physics/Collision/ShapeFilter.h>
#include <Jolt/Physics/Collision/TransformedShape.h>
#ifdef JPH_DEBUG_RENDERER
#include <Jolt/Renderer/DebugRenderer.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <new>
#include <span>
#include <utility>

namespace {

constexpr auto sub_type = JPH::EShapeSubType::User1;

JPH::Vec3 to_jolt(const espalier::Vec3& v) { return {v.x, v.y, v.z}; }
espalier::Vec3 from_jolt(JPH::Vec3Arg v) { return {v.GetX(), v.GetY(), v.GetZ()}; }

/// Returns the box in the mesh's own units; an axis of scale 0 is not valid in Jolt.
espalier::Box unscaled(const JPH::AABox& box, JPH::Vec3Arg scale) {
    const JPH::Vec3 a = box.mMin / scale, b = box.mMax / scale;
    return {from_jolt(JPH::Vec3::sMin(a, b)), from_jolt(JPH::Vec3::sMax(a, b))};
}

/// A convex shape against triangles, and the box in which these may touch it.
struct ConvexCollision : JPH::CollideConvexVsTriangles {
    using CollideConvexVsTriangles::CollideConvexVsTriangles;
    [[nodiscard]] const JPH::AABox& box() const { return mBoundsOf1InSpaceOf2; }
    static const JPH::ConvexShape* shape_of(const JPH::Shape* shape) {
        return static_cast<const JPH::ConvexShape*>(shape);
    }
};

struct SphereCollision : JPH::CollideSphereVsTriangles {
    using CollideSphereVsTriangles::CollideSphereVsTriangles;
    [[nodiscard]] JPH::AABox box() const {
        const JPH::Vec3 reach = JPH::Vec3::sReplicate(std::sqrt(mRadiusPlusMaxSeparationSq) * (1.0f + 0x1p-20f));
        return {mSphereCenterIn2 - reach, mSphereCenterIn2 + reach};
    }
    static const JPH::SphereShape* shape_of(const JPH::Shape* shape) {
        return static_cast<const JPH::SphereShape*>(shape);
    }
};

/// Settings of a cast that lets the shape grow, as Jolt has since 5.5.1.
template <class Settings>
concept GrowsShape = requires(const Settings& settings) {
    settings.mExtraConvexRadius;
};

/// Returns by how much the shape of a cast grows.
template <class Settings>
float extra_radius(const Settings& settings) {
    if constexpr (GrowsShape<Settings>) return settings.mExtraConvexRadius;
    return 0.0f;
}

}  // namespace

EspalierJoltShape::EspalierJoltShape(const espalier::Blob& blob)
    : Shape(JPH::EShapeType::User1, sub_type), blob_(blob) {
    const std::uint32_t count = blob.triangle_count();
    id_bits_ = count > 1 ? static_cast<JPH::uint>(std::bit_width(count - 1)) : 0;
}

espalier::TriangleId EspalierJoltShape::triangle_of(const JPH::SubShapeID& id) const {
    JPH::SubShapeID rest;
    return {id_bits_ == 0 ? 0 : id.PopID(id_bits_, rest)};
}

JPH::AABox EspalierJoltShape::GetLocalBounds() const {
    const espalier::Box box = blob_.bounds();
    return {to_jolt(box.min), to_jolt(box.max)};
}

const JPH::PhysicsMaterial* EspalierJoltShape::GetMaterial(const JPH::SubShapeID&) const {
    return JPH::PhysicsMaterial::sDefault;
}

JPH::Vec3 EspalierJoltShape::GetSurfaceNormal(const JPH::SubShapeID& id, JPH::Vec3Arg) const {
    const espalier::Triangle triangle = *triangle_at(blob_, triangle_of(id));
    const JPH::Vec3 a = to_jolt(triangle.a), b = to_jolt(triangle.b), c = to_jolt(triangle.c);
    return (b - a).Cross(c - a).NormalizedOr(JPH::Vec3::sAxisY());
}

void EspalierJoltShape::GetSupportingFace(const JPH::SubShapeID& id, JPH::Vec3Arg, JPH::Vec3Arg scale,
                                          JPH::Mat44Arg transform, SupportingFace& vertices) const {
    const espalier::Triangle triangle = *triangle_at(blob_, triangle_of(id));
    const JPH::Mat44 placed = transform.PreScaled(scale);
    vertices.resize(3);
    vertices[0] = placed * to_jolt(triangle.a);
    vertices[1] = placed * to_jolt(triangle.b);
    vertices[2] = placed * to_jolt(triangle.c);
    if (JPH::ScaleHelpers::IsInsideOut(scale)) std::swap(vertices[1], vertices[2]);
}

void EspalierJoltShape::GetSubmergedVolume(JPH::Mat44Arg, JPH::Vec3Arg, const JPH::Plane&, float& total,
                                           float& submerged,
                                           JPH::Vec3& center JPH_IF_DEBUG_RENDERER(, JPH::RVec3Arg)) const {
    JPH_ASSERT(false, "a static mesh does not float");
    total = submerged = 0.0f;
    center = JPH::Vec3::sZero();
}

#ifdef JPH_DEBUG_RENDERER
void EspalierJoltShape::Draw(JPH::DebugRenderer* renderer, JPH::RMat44Arg transform, JPH::Vec3Arg scale,
                             JPH::ColorArg color, bool, bool) const {
    const JPH::RMat44 placed = transform.PreScaled(scale);
    const auto draw = [&](espalier::TriangleId, const espalier::Triangle& t) {
        renderer->DrawTriangle(placed * to_jolt(t.a), placed * to_jolt(t.b), placed * to_jolt(t.c), color);
    };
    (void)for_each_triangle(blob_, draw);
}
#endif

JPH::uint8 EspalierJoltShape::active_edges(espalier::TriangleId triangle) const {
    const espalier::Result<espalier::EdgeKinds> kinds = edge_kinds(blob_, triangle);
    if (!kinds) return 0b111;
    const auto is_active = [](espalier::EdgeKind kind) {
        return kind == espalier::EdgeKind::convex || kind == espalier::EdgeKind::boundary;
    };
    return static_cast<JPH::uint8>((is_active(kinds->ab) ? 1 : 0) | (is_active(kinds->bc) ? 2 : 0) |
                                   (is_active(kinds->ca) ? 4 : 0));
}

template <class Visitor>
void EspalierJoltShape::visit(const JPH::AABox& box, JPH::Vec3Arg scale, const JPH::SubShapeIDCreator& ids,
                              Visitor&& visitor) const {
    (void)for_each_overlap(  // a refusal, of a NaN, has no triangles
        blob_, unscaled(box, scale), [&](espalier::TriangleId triangle, const espalier::Triangle& corners) {
            const bool more = visitor(to_jolt(corners.a), to_jolt(corners.b), to_jolt(corners.c),
                                      active_edges(triangle), ids.PushID(triangle.index, id_bits_).GetID());
            return more ? espalier::Visit::next : espalier::Visit::stop;
        });
}

bool EspalierJoltShape::CastRay(const JPH::RayCast& ray, const JPH::SubShapeIDCreator& ids,
                                JPH::RayCastResult& hit) const {
    espalier::Ray segment = {from_jolt(ray.mOrigin), from_jolt(ray.mDirection), 0.0f, hit.mFraction};
    const espalier::RayHit found = raycast(blob_, segment);
    if (!found || found.t >= hit.mFraction) return false;
    hit.mFraction = found.t;
    hit.mSubShapeID2 = ids.PushID(found.triangle.index, id_bits_).GetID();
    return true;
}

void EspalierJoltShape::CastRay(const JPH::RayCast& ray, const JPH::RayCastSettings& settings,
                                const JPH::SubShapeIDCreator& ids, JPH::CastRayCollector& collector,
                                const JPH::ShapeFilter& filter) const {
    if (!filter.ShouldCollide(this, ids.GetID())) return;
    espalier::Ray segment = {from_jolt(ray.mOrigin), from_jolt(ray.mDirection), 0.0f, 1.0f};
    if (settings.mBackFaceModeTriangles == JPH::EBackFaceMode::IgnoreBackFaces)
        segment.culling = espalier::FaceCulling::back;
    (void)for_each_hit(blob_, segment, [&](const espalier::RayHit& found) {
        if (found.t < collector.GetEarlyOutFraction()) {
            JPH::RayCastResult hit;
            hit.mBodyID = JPH::TransformedShape::sGetBodyID(collector.GetContext());
            hit.mFraction = found.t;
            hit.mSubShapeID2 = ids.PushID(found.triangle.index, id_bits_).GetID();
            collector.AddHit(hit);
        }
        return collector.ShouldEarlyOut() ? espalier::Visit::stop : espalier::Visit::next;
    });
}

void EspalierJoltShape::CollidePoint(JPH::Vec3Arg point, const JPH::SubShapeIDCreator& ids,
                                     JPH::CollidePointCollector& collector, const JPH::ShapeFilter& filter) const {
    if (!filter.ShouldCollide(this, ids.GetID())) return;
    if (contains(blob_, from_jolt(point)).yes())  // a surface that is not closed has no inside
        collector.AddHit({JPH::TransformedShape::sGetBodyID(collector.GetContext()), ids.GetID()});
}

void EspalierJoltShape::CollideSoftBodyVertices(JPH::Mat44Arg transform, JPH::Vec3Arg scale,
                                                const JPH::CollideSoftBodyVertexIterator& vertices, JPH::uint count,
                                                int shape) const {
    JPH::CollideSoftBodyVerticesVsTriangles collision(transform, scale);
    const bool is_uniform = scale.GetX() == scale.GetY() && scale.GetY() == scale.GetZ();
    for (JPH::CollideSoftBodyVertexIterator v = vertices, end = vertices + static_cast<int>(count); v != end; ++v) {
        if (!(v.GetInvMass() > 0.0f)) continue;
        collision.StartVertex(v);
        const JPH::Vec3 local = collision.mLocalPosition / scale;
        const auto process = [&](espalier::TriangleId, const espalier::Triangle& t) {
            collision.ProcessTriangle(to_jolt(t.a), to_jolt(t.b), to_jolt(t.c));
        };
        const espalier::ClosestPoint nearest = closest_point(blob_, from_jolt(local));
        if (nearest) {
            process(nearest.triangle, *triangle_at(blob_, nearest.triangle));
            // Where axes have different scales another triangle may be the closest, in a box around this one's point.
            if (!is_uniform) {
                const JPH::Vec3 reach = JPH::Vec3::sReplicate(std::sqrt(collision.mClosestDistanceSq));
                const JPH::AABox box(collision.mLocalPosition - reach, collision.mLocalPosition + reach);
                (void)for_each_overlap(blob_, unscaled(box, scale), process);
            }
        }
        collision.FinishVertex(v, shape);
    }
}

/// The state of a list of triangles in pages. Jolt copies it as bytes.
struct EspalierJoltShape::Walk {
    espalier::Box box;
    espalier::Cursor next;
    JPH::Mat44 placed;
    bool is_inside_out;
    bool is_done;
};

void EspalierJoltShape::GetTrianglesStart(GetTrianglesContext& context, const JPH::AABox& box, JPH::Vec3Arg place,
                                          JPH::QuatArg rotation, JPH::Vec3Arg scale) const {
    static_assert(sizeof(Walk) <= sizeof(GetTrianglesContext) && alignof(Walk) <= alignof(GetTrianglesContext));
    const JPH::Mat44 transform = JPH::Mat44::sRotationTranslation(rotation, place);
    const JPH::AABox local = box.Transformed(transform.InversedRotationTranslation());
    new (&context)
        Walk{unscaled(local, scale), {}, transform.PreScaled(scale), JPH::ScaleHelpers::IsInsideOut(scale), false};
}

int EspalierJoltShape::GetTrianglesNext(GetTrianglesContext& context, int most, JPH::Float3* vertices,
                                        const JPH::PhysicsMaterial** materials) const {
    Walk& walk = reinterpret_cast<Walk&>(context);
    if (walk.is_done) return 0;
    std::array<espalier::TriangleId, 256> page;
    const std::size_t places = std::min<std::size_t>(page.size(), static_cast<std::size_t>(most));
    const espalier::Filled found = collect_overlaps(blob_, walk.box, std::span(page).first(places), walk.next);
    walk.next = found.next;
    walk.is_done = found.status != espalier::QueryStatus::output_full;
    for (const espalier::TriangleId id : found.in(page)) {
        const espalier::Triangle triangle = *triangle_at(blob_, id);
        const espalier::Vec3 corners[] = {triangle.a, walk.is_inside_out ? triangle.c : triangle.b,
                                          walk.is_inside_out ? triangle.b : triangle.c};
        for (const espalier::Vec3& corner : corners) (walk.placed * to_jolt(corner)).StoreFloat3(vertices++);
        if (materials != nullptr) *materials++ = JPH::PhysicsMaterial::sDefault;
    }
    return static_cast<int>(found.count);
}

template <class Collision>
void EspalierJoltShape::collide(const JPH::Shape* shape, const JPH::Shape* mesh, JPH::Vec3Arg scale,
                                JPH::Vec3Arg mesh_scale, JPH::Mat44Arg transform, JPH::Mat44Arg mesh_transform,
                                const JPH::SubShapeIDCreator& ids, const JPH::SubShapeIDCreator& mesh_ids,
                                const JPH::CollideShapeSettings& settings, JPH::CollideShapeCollector& collector,
                                const JPH::ShapeFilter&) {
    Collision collision(Collision::shape_of(shape), scale, mesh_scale, transform, mesh_transform, ids.GetID(), settings,
                        collector);
    static_cast<const EspalierJoltShape*>(mesh)->visit(
        collision.box(), mesh_scale, mesh_ids,
        [&](JPH::Vec3Arg a, JPH::Vec3Arg b, JPH::Vec3Arg c, JPH::uint8 active, const JPH::SubShapeID& id) {
            collision.Collide(a, b, c, active, id);
            return !collector.ShouldEarlyOut();
        });
}

template <class Cast>
void EspalierJoltShape::cast(const JPH::ShapeCast& cast, const JPH::ShapeCastSettings& settings, const JPH::Shape* mesh,
                             JPH::Vec3Arg mesh_scale, const JPH::ShapeFilter&, JPH::Mat44Arg mesh_transform,
                             const JPH::SubShapeIDCreator& ids, const JPH::SubShapeIDCreator& mesh_ids,
                             JPH::CastShapeCollector& collector) {
    const auto& self = *static_cast<const EspalierJoltShape*>(mesh);
    // The box around the shape moves first: until it touches, the shape is free, and behind that contact it begins.
    const JPH::Vec3 more = JPH::Vec3::sReplicate(extra_radius(settings));
    const JPH::AABox start(cast.mShapeWorldBounds.mMin - more, cast.mShapeWorldBounds.mMax + more);
    const espalier::SweepHit first =
        sweep(self.blob_, unscaled(start, mesh_scale), from_jolt(cast.mDirection / mesh_scale));
    if (first.status == espalier::QueryStatus::not_found) return;
    const float end = std::min(1.0f, collector.GetPositiveEarlyOutFraction());
    if (first.t > end) return;
    JPH::AABox way = start;
    way.Translate(first.t * cast.mDirection);
    JPH::AABox last = start;
    last.Translate(end * cast.mDirection);
    way.Encapsulate(last);
    Cast visitor(cast, settings, mesh_scale, mesh_transform, ids, collector);
    self.visit(way, mesh_scale, mesh_ids,
               [&](JPH::Vec3Arg a, JPH::Vec3Arg b, JPH::Vec3Arg c, JPH::uint8 active, const JPH::SubShapeID& id) {
                   visitor.Cast(a, b, c, active, id);
                   return !collector.ShouldEarlyOut();
               });
}

void EspalierJoltShape::register_type() {
    JPH::ShapeFunctions& functions = JPH::ShapeFunctions::sGet(sub_type);
    functions.mConstruct = []() -> JPH::Shape* { return new EspalierJoltShape(espalier::Blob()); };
    functions.mColor = JPH::Color::sGreen;
    using JPH::CollisionDispatch;
    for (const JPH::EShapeSubType convex : JPH::sConvexSubShapeTypes) {
        CollisionDispatch::sRegisterCollideShape(convex, sub_type, collide<ConvexCollision>);
        CollisionDispatch::sRegisterCastShape(convex, sub_type, cast<JPH::CastConvexVsTriangles>);
        CollisionDispatch::sRegisterCollideShape(sub_type, convex, CollisionDispatch::sReversedCollideShape);
        CollisionDispatch::sRegisterCastShape(sub_type, convex, CollisionDispatch::sReversedCastShape);
    }
    CollisionDispatch::sRegisterCollideShape(JPH::EShapeSubType::Sphere, sub_type, collide<SphereCollision>);
    CollisionDispatch::sRegisterCastShape(JPH::EShapeSubType::Sphere, sub_type, cast<JPH::CastSphereVsTriangles>);
}
