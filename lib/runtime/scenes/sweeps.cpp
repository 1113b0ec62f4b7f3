// Shapes that move, against all instances of a scene.
#include <espalier/scene.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>
#include <runtime/sweeps/contact_time.hpp>
#include <runtime/transforms/local_shape.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns the box around a shape for its sweep: wider by what the lattice of an instance may move it farther than a
/// shape that stays where it is (docs/numerics.md, Scenes).
template <class Shape>
ShapeBounds bounds_of_sweep(const SceneData& scene, const Shape& shape) {
    ShapeBounds bounds = bounds_of(shape);
    const float farther = scene.coarsest_step * 0x1p-6f;
    bounds.low = {bounds.low.x - farther, bounds.low.y - farther, bounds.low.z - farther};
    bounds.high = {bounds.high.x + farther, bounds.high.y + farther, bounds.high.z + farther};
    return bounds;
}

/// Returns the place of a contact in the order of contacts: by its t without a skin, those at the start before others.
std::uint32_t order_of(const SweepHit& hit, float contact_t) {
    return hit.starts_overlapping ? 0 : magnitude_bits(contact_t) + 1;
}

template <class Shape>
InScene<SweepHit> sweep_to_contact(const SceneView& scene, const Shape& shape, const Vec3& displacement,
                                   const SceneSweepOptions& options, float& contact_t);

/// Returns the options of a sweep as those of a mesh or of a tile at the place of an instance.
template <class Options, class Part>
Options local_options(const SceneSweepOptions& world, const FilterOfInstance& keep, const Part& part) {
    const Transform& transform = keep.instance.transform;
    const float skin = to_local(transform, Sphere{transform.translation, world.skin}).radius;
    return {keep.of(part), world.culling, world.ignore_leaving, skin};
}
template <class Shape>
InScene<SweepHit> sweep_part(const Blob& mesh, const Shape& local, const Vec3& displacement,
                             const SceneSweepOptions& options, const FilterOfInstance& keep, float& contact_t) {
    return in_tile(detail::sweep_to_contact(mesh, local, displacement, local_options<SweepOptions>(options, keep, mesh),
                                            contact_t));
}
template <class Shape>
InScene<SweepHit> sweep_part(const BakedScene& tile, const Shape& local, const Vec3& displacement,
                             const SceneSweepOptions& options, const FilterOfInstance& keep, float& contact_t) {
    return sweep_to_contact(tile, local, displacement, local_options<SceneSweepOptions>(options, keep, tile),
                            contact_t);
}

/// Moves the contact of an instance to the world and keeps it if it is earlier than the best one, whose t without a
/// skin is `contact_t`. Compiled once for all shapes.
ESPALIER_NOINLINE bool keep_first(BestInScene<SweepHit>& best, const VisitedInstance& instance, InScene<SweepHit>& hit,
                                  float t, float& contact_t) {
    if (!best.is_better(*hit, instance.id_of(hit.instance), order_of(*hit, t), order_of(*best, contact_t)))
        return false;
    hit.hit.point = to_world(instance.transform, hit->point);
    hit.hit.normal = normal_to_world(instance.transform, hit->normal);
    hit.hit.face_normal = normal_to_world(instance.transform, hit->face_normal);
    best.set(*hit, instance.id_of(hit.instance));
    contact_t = t;
    return true;
}

/// Returns what sweep() returns. Where that is a contact, writes the t that it has without a skin.
template <class Shape>
InScene<SweepHit> sweep_to_contact(const SceneView& scene, const Shape& shape, const Vec3& displacement,
                                   const SceneSweepOptions& options, float& contact_t) {
    const SceneData& data = data_of(scene);
    const ShapeBounds bounds = bounds_of_sweep(data, shape);
    const bool is_sound =
        is_finite(displacement) && has_finite_radius(shape) && is_radius(options.skin) && is_finite(options.skin);
    const QueryStatus status = !scene ? refusal_of(scene) : is_sound ? bounds.status : QueryStatus::invalid_argument;
    if (is_refused(status)) return BestInScene<SweepHit>(status).result();
    SweepHit miss;
    miss.status = QueryStatus::not_found;
    miss.t = 1.0f;
    BestInScene<SweepHit> best(miss);
    if (status == QueryStatus::not_found) return best.result();  // an empty shape
    const SceneFilter& filter = options.filter;
    const float magnitude =
        maximum(maximum(absolute(displacement.x), absolute(displacement.y)), absolute(displacement.z));
    const Passage passage(data, bounds, displacement, magnitude);
    const auto move = [&](const VisitedInstance& instance, float& limit) {
        const FilterOfInstance keep = {filter, instance};
        const LocalShape<Shape> local(instance.transform, shape);
        float t = 0.0f;
        InScene<SweepHit> hit = instance.query([&](const auto& part) {
            return sweep_part(part, local.shape(), direction_to_local(instance.transform, displacement), options, keep,
                              t);
        });
        if (keep_first(best, instance, hit, t, contact_t)) limit = passage.key_of(limit_above(t));
        return Visit::next;
    };
    visit_nearest_instances(data, filter.mask(), passage, passage.key_of(1.0f), move);
    return best.result();
}

}  // namespace

template <SweptShape Shape>
InScene<SweepHit> sweep(const SceneView& scene, const Shape& shape, Vec3 displacement,
                        const SceneSweepOptions& options) noexcept {
    float contact_t = 0.0f;
    return sweep_to_contact(scene, shape, displacement, options, contact_t);
}
template InScene<SweepHit> sweep(const SceneView&, const Sphere&, Vec3, const SceneSweepOptions&) noexcept;
template InScene<SweepHit> sweep(const SceneView&, const Capsule&, Vec3, const SceneSweepOptions&) noexcept;
template InScene<SweepHit> sweep(const SceneView&, const Box&, Vec3, const SceneSweepOptions&) noexcept;
template InScene<SweepHit> sweep(const SceneView&, const OrientedBox&, Vec3, const SceneSweepOptions&) noexcept;
template InScene<SweepHit> sweep(const SceneView&, const ConvexHull&, Vec3, const SceneSweepOptions&) noexcept;

}  // namespace espalier
