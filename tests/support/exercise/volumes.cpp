#include "run.hpp"

namespace espalier::tests::exercises {

namespace {

/// The three ways of asking about one shape.
template <class Shape>
void exercise_volume(Exercise& run, const Shape& shape) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const bool any = overlaps(blob, shape).yes();
    std::array<TriangleId, 64> seen;
    std::uint32_t visited = 0;
    const bool ascends = blob.duplicate_reference_count() == 0;
    const QueryStatus status = for_each_overlap(blob.for_lists(), shape, [&](TriangleId triangle) {
        verdict.require(triangle.index < blob.triangle_count(), "a volume overlaps a triangle that does not exist");
        // Bytes of a stranger may have references outside of their triangle's box: such a triangle may come again.
        verdict.require(visited == 0 || !ascends || triangle.index > seen[visited - 1].index,
                        "overlaps are not in ascending order");
        seen[visited] = triangle;
        run.hash.add(triangle.index);
        return ++visited == seen.size() ? Visit::stop : Visit::next;
    });
    verdict.require((status == QueryStatus::stopped) == (visited == seen.size()), "the status of a visitor is wrong");
    // Bytes of a stranger may have references outside of their boxes: those report nothing.
    verdict.require((visited > 0) == any || !ascends, "a visitor of overlaps and any overlap disagree");
    std::array<TriangleId, 5> page;
    Cursor from;
    for (std::uint32_t found = 0; found < 3 * page.size();) {
        const Filled answer = collect_overlaps(blob.for_lists(), shape, page, from);
        verdict.require(answer.count <= page.size(), "a page of overlaps has more than it can hold");
        verdict.require(is_refused(answer.status) ? answer.status == status : !is_refused(status),
                        "a page of overlaps and the visitor have different statuses");
        for (std::uint32_t i = 0; i < answer.count; ++i, ++found) {
            verdict.require(found < visited && page[i] == seen[found], "a page of overlaps and the visitor disagree");
            run.hash.add(page[i].index);
        }
        if (answer.status != QueryStatus::output_full) {
            verdict.require(answer.status != QueryStatus::ok || found == visited, "pages of overlaps end too early");
            break;
        }
        from = answer.next;
    }
    const auto anywhere = static_cast<std::uint32_t>(run.random.next());
    run.hash.add(collect_overlaps(blob.for_lists(), shape, page, {{anywhere}}).next.place[0]);
}

/// In lattice steps: near the asset more often than not, at the ends of the range, or anything.
std::int32_t some_steps(const Exercise& run, Random& random, int axis) {
    const std::int32_t extent = run.blob.unmeasured().lattice().extent[axis];
    const auto kind = random.below(8);
    if (kind == 0) return static_cast<std::int32_t>(random.next());
    if (kind == 1) return random.coin() ? max_lattice_coordinate : -max_lattice_coordinate;
    if (kind == 2) return 0;
    if (kind == 3) return extent;
    return random.between(-extent / 4 - 1, extent + extent / 4 + 1);
}

}  // namespace

void exercise_volumes(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    const Vec3 a = some_point(blob, random), b = some_point(blob, random), c = some_point(blob, random);
    const Vec3 d = some_point(blob, random);
    const float length = some_length(blob, random);
    exercise_volume(run, Sphere{a, length});
    // One to three of the others a round.
    switch (random.below(4)) {
        case 0:
            exercise_volume(run, Capsule{a, b, length});
            break;
        case 1:
            exercise_volume(run, Box{a, b});
            exercise_volume(run, Box{a, moved(a, {length, length, length})});
            break;
        case 2:
            exercise_volume(run, OrientedBox{a, {b, c, d}});
            exercise_volume(run, OrientedBox{a, {{length, 0.0f, length}, plain_difference(b, a), {}}});
            exercise_volume(run, Cone{a, random.coin() ? d : plain_difference(b, a), length});
            break;
        default: {
            exercise_volume(run, Triangle{a, b, c});
            std::array<Plane, max_planes + 1> planes;
            for (Plane& plane : planes) {
                const Vec3 on = some_point(blob, random);
                const Vec3 normal = random.below(8) == 0 ? on : random.in_cube(1.0f);
                plane = {normal, plain_sum(plain_dot(normal, on), plain_product(0.1f, length))};
            }
            const std::size_t count = random.coin() ? random.below(7) : random.below(planes.size() + 1);
            exercise_volume(run, ConvexVolume{std::span<const Plane>(planes).first(count)});
        }
    }
}

void exercise_steps(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    const auto some_place = [&] {
        const std::int32_t x = some_steps(run, random, 0);
        const std::int32_t y = some_steps(run, random, 1);
        return LatticePoint{x, y, some_steps(run, random, 2)};
    };
    const LatticeSegment segment = {some_place(), some_place()};
    const LatticeHit hit = raycast(blob, segment);
    verdict.require(occluded(blob, segment).status() == hit.status, "occluded and raycast of a segment disagree");
    verdict.require(bool(hit) == (hit.triangle != no_triangle), "a segment that hits nothing names a triangle");
    if (hit) {
        verdict.require(hit.triangle.index < blob.triangle_count(), "a segment hit a triangle that does not exist");
        verdict.require(hit.t <= 1u << 31, "a segment is hit beyond its end");
        run.hash.add(hit.triangle.index, hit.t, static_cast<std::uint32_t>(hit.side));
    }
    exercise_volume(run, LatticeBox{segment.from, segment.to});
    const Lattice lattice = blob.unmeasured().lattice();
    const Box world = {some_point(blob, random), some_point(blob, random)};
    if (const Result<LatticePoint> nearest = to_lattice(lattice, world.min)) {
        run.hash.add(static_cast<std::uint32_t>(nearest->x));
        const Vec3 back = to_local(lattice, *nearest);
        verdict.require(is_number(back.x) && is_number(back.y) && is_number(back.z), "a lattice point is nowhere");
    }
    if (const Result<LatticeBox> around = to_lattice(lattice, world)) {
        verdict.require(overlaps(blob, *around).yes() || !overlaps(blob, world).yes(),
                        "a box in steps misses what the box in it overlaps");
        run.hash.add(static_cast<std::uint32_t>(around->max.z));
    }
}

}  // namespace espalier::tests::exercises
