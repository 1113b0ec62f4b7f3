#include "run.hpp"

namespace espalier::tests::exercises {

namespace {

/// Without the sign bit, also of a number that a mode of the processor takes for zero.
float absolute_of(float value) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & 0x7FFFFFFFu); }

template <class Shape>
void exercise_sweep(Exercise& run, const Shape& shape, Vec3 displacement) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const std::uint32_t parity = run.random.below(2);
    const auto filter = [&](TriangleId triangle) {
        verdict.require(triangle.index < blob.triangle_count(),
                        "a filter was asked about a triangle that does not exist");
        return triangle.index % 2 == parity;
    };
    const float skin = absolute_of(run.random.below(8) == 0 ? 0.0f : some_length(blob, run.random));
    SweepOptions options;
    if (run.random.coin()) options.filter = filter;
    options.culling = static_cast<FaceCulling>(run.random.below(4));
    options.ignore_leaving = run.random.coin();
    options.skin = skin;
    const SweepHit hits[3] = {sweep(blob, shape, displacement), sweep(blob, shape, displacement, filter),
                              sweep(blob, shape, displacement, options)};
    verdict.require(hits[0] || !hits[1], "a sweep under a filter hits more than without");
    verdict.require(is_refused(hits[0].status) == is_refused(hits[1].status), "a filter changes what is refused");
    verdict.require(hits[0] || !hits[2], "a sweep under options hits more than without");
    verdict.require(is_refused(hits[2].status) == (is_refused(hits[0].status) || !(skin < infinity)),
                    "options change what is refused, or a skin is not refused");
    for (const SweepHit& hit : hits) {
        run.hash.add(static_cast<std::uint32_t>(hit.status));
        if (!hit) {
            verdict.require(hit.triangle == no_triangle && hit.t == (is_refused(hit.status) ? 0.0f : 1.0f),
                            "a sweep that hit nothing has a hit");
            continue;
        }
        verdict.require(hit.triangle.index < blob.triangle_count(), "a sweep hit a triangle that does not exist");
        verdict.require(hit.t >= 0.0f && hit.t < 1.0f, "a sweep's t is out of range or NaN");
        verdict.require(!hit.starts_overlapping || hit.t == 0.0f, "a sweep that starts overlapping takes its time");
        const Vec3& n = hit.normal;
        verdict.require(n.x * n.x + n.y * n.y + n.z * n.z > 0.999f, "a sweep's normal is not of unit length");
        verdict.require(is_number(hit.point.x + hit.point.y + hit.point.z), "a sweep's point is NaN");
        run.hash.add(hit.triangle.index, hit.t, hit.point, hit.normal, hit.face_normal,
                     static_cast<std::uint32_t>(hit.feature));
        verdict.require(hit.feature <= Feature::vertex_c, "a sweep's feature does not exist");
    }
}

}  // namespace

void exercise_sweeps(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    const Vec3 a = some_point(blob, random), b = some_point(blob, random), c = some_point(blob, random);
    const float length = some_length(blob, random);
    const Vec3 way = random.coin() ? plain_difference(c, a) : c;
    exercise_sweep(run, Sphere{a, length}, way);
    exercise_sweep(run, Capsule{a, b, length}, way);
    exercise_sweep(run, random.coin() ? Box{a, b} : Box{a, moved(a, {length, length, length})}, way);
    // One of the two at random: from a start in overlap, either takes longer than all others together.
    if (random.coin())
        return exercise_sweep(
            run, OrientedBox{a, {plain_difference(b, a), plain_difference(c, b), {length, 0.0f, -length}}}, way);
    const Vec3 vertices[] = {a, b, c, moved(a, {length, length, 0.0f}), moved(b, {0.0f, length, length}), c};
    exercise_sweep(run, ConvexHull{std::span(vertices).first(random.below(7))}, way);
}

}  // namespace espalier::tests::exercises
