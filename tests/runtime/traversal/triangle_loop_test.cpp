// The measuring device itself: a loop that leaves out what is clear of a query answers as one that asks of everything.
#include "support/testing.hpp"

#include <runtime/lattice/rounder.hpp>

#include "support/loops/pair_loop.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/placement_maker.hpp"
#include "support/queries/shape_maker.hpp"
#include "support/queries/sweep_maker.hpp"

namespace espalier::tests::triangle_loop_test {
namespace {

/// Both loops over one blob.
struct Loops {
    explicit Loops(const TestBlob& test)
        : data(detail::data_of(test.opened.blob)), quick(test.decoded), whole(test.decoded, LeftOut::nothing) {}

    /// The number of answers, once they are equal.
    std::size_t check(const Ray& ray) const {
        CAPTURE(describe(ray));
        detail::LatticeRay rounded;
        if (!detail::round_ray(data, ray, rounded)) return 0;
        const auto hits = quick.every_hit(rounded), expected = whole.every_hit(rounded);
        REQUIRE(hits.size() == expected.size());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            REQUIRE(hits[i].index == expected[i].index);
            REQUIRE(same_bits(hits[i].hit.tau, expected[i].hit.tau));
        }
        return hits.size();
    }
    std::size_t check(const Sphere& sphere) const {
        CAPTURE(describe(sphere));
        detail::RoundedPoint rounded;
        if (detail::round_point(data, sphere.center, sphere.radius, rounded) != QueryStatus::ok) return 0;
        const auto overlaps = quick.every_overlap(rounded);
        REQUIRE(overlaps == whole.every_overlap(rounded));
        const auto sorted = whole.by_distance(rounded);
        for (const std::size_t count : {std::size_t{1}, std::size_t{7}, TriangleBounds::all}) {
            const auto few = quick.by_distance(rounded, count);
            REQUIRE(few.size() == std::min(count, sorted.size()));
            for (std::size_t i = 0; i < few.size(); ++i) REQUIRE(same_bits(few[i], sorted[i]));
        }
        detail::WindingRay ray;
        if (detail::shortest_way_out(data, rounded, ray)) {
            const detail::Winding winding = quick.winding(ray), expected = whole.winding(ray);
            REQUIRE(winding.on_surface == expected.on_surface);
            REQUIRE(winding.number == expected.number);
        }
        return overlaps.size();
    }
    template <class Shape>
    std::size_t check_volume(const Shape& shape) const {
        CAPTURE(describe(shape));
        detail::Rounded<Shape> rounded;
        if (round_volume(data, shape, rounded) != QueryStatus::ok) return 0;
        const auto overlaps = quick.every_overlap(rounded);
        REQUIRE(overlaps == whole.every_overlap(rounded));
        return overlaps.size();
    }
    template <class Shape>
    std::size_t check_distance(Shape& shape, float max_distance) const {
        prepare(shape);
        shape.radius = detail::radius_in_steps(data, max_distance);
        const auto pair = quick.closest_pair(shape), expected = whole.closest_pair(shape);
        REQUIRE(pair.has_value() == expected.has_value());
        if (!pair) return 0;
        REQUIRE(pair->index == expected->index);
        REQUIRE(same_bits(pair->distance.squared, expected->distance.squared));
        REQUIRE(same_bits(pair->distance.along, expected->distance.along));
        return 1;
    }
    std::size_t check_distances(const Capsule& capsule, const Box& box, float max_distance) const {
        CAPTURE(describe(capsule));
        CAPTURE(describe(box));
        CAPTURE(max_distance);
        std::size_t pairs = 0;
        detail::DistantSegment segment;
        if (detail::round_segment(data, {capsule.from, capsule.to}, segment.segment) == QueryStatus::ok)
            pairs += check_distance(segment, max_distance);
        const bool is_box = box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z;
        detail::DistantBox distant;
        if (is_box && detail::round_segment(data, {box.min, box.max}, distant.segment) == QueryStatus::ok)
            pairs += check_distance(distant, max_distance);
        return pairs;
    }
    template <class Shape>
    std::size_t check_sweep(const Moving<Shape>& moving) const {
        CAPTURE(describe(moving));
        auto rounded = sweep_of(moving.shape);
        if (round_sweep(data, moving.shape, moving.displacement, rounded) != QueryStatus::ok) return 0;
        const auto all = [](TriangleId) { return true; };
        const detail::FoundContact found = quick.first_contact(rounded, all);
        const detail::FoundContact expected = whole.first_contact(rounded, all);
        REQUIRE(found.tick == expected.tick);
        if (found.tick == detail::no_contact) return 0;
        REQUIRE(found.index == expected.index);
        return 1;
    }

    const detail::BlobData& data;
    TriangleLoop quick;
    TriangleLoop whole;
};

struct PairsFound {
    std::uint64_t contacts = 0;
    std::uint64_t distances = 0;  ///< above 0
};

void check_pair_loops(const TestBlob& a, const TestBlob& b, std::uint64_t seed, std::uint64_t count,
                      PairsFound& found) {
    CAPTURE(a.name);
    CAPTURE(b.name);
    const TriangleGroups a_groups(a.decoded), b_groups(b.decoded);
    PlacementMaker maker(a.decoded, b.decoded, seed);
    for (std::uint64_t n = 0; n < count; ++n) {
        const std::uint64_t kind = (seed + n) % 4;
        const double proportion = std::exp2(static_cast<double>(maker.numbers().between(-8, 8)));
        const Transform placement = kind == 0   ? maker.random()
                                    : kind == 1 ? maker.adversarial()
                                    : kind == 2 ? maker.beside(proportion)
                                                : maker.face_on_face(proportion);
        CAPTURE(describe(placement));
        detail::PairFrame frame;
        if (place_pair(detail::data_of(a.opened.blob), detail::data_of(b.opened.blob), placement, frame) !=
            QueryStatus::ok)
            continue;
        const PairLoop quick(frame, a_groups, b_groups);
        const PairLoop whole(frame, a_groups, b_groups, LeftOut::nothing);
        const auto pairs = quick.every_contact();
        REQUIRE(pairs == whole.every_contact());
        found.contacts += pairs.size();
        const auto nearest = quick.nearest_pairs(), expected = whole.nearest_pairs();
        REQUIRE_FALSE(expected.empty());
        REQUIRE(nearest.size() == expected.size());
        for (std::size_t k = 0; k < nearest.size(); ++k) {
            REQUIRE(same_bits(nearest[k].distance.squared, expected[k].distance.squared));
            REQUIRE(nearest[k].pair == expected[k].pair);
        }
        const float radius = std::sqrt(expected.front().distance.squared);
        for (const float within : {std::nextafter(radius, 0.0f), radius, std::nextafter(radius, radius * 2.0f)}) {
            const bool answer = whole.is_any_within(within);
            REQUIRE(quick.is_any_within(within) == answer);
            REQUIRE((first_within(nearest, within) != nullptr) == answer);
        }
        if (radius > 0.0f) ++found.distances;
    }
}

TEST_CASE("oracle: triangles that the loop leaves out do not change its answer") {
    std::size_t rays = 0, spheres = 0, volumes = 0, distances = 0, sweeps = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        const Loops loops(blob);
        QueryMaker queries(blob.decoded, 1700);
        ShapeMaker shapes(blob.decoded, 1701);
        SweepMaker moves(blob.decoded, 1702);
        for (std::uint64_t i = 0; i < scaled_share(30); ++i) {
            const bool awkward = i % 2 == 0;
            rays += loops.check(queries.any_ray());
            spheres += loops.check(awkward ? queries.sphere() : queries.random_sphere());
            const Capsule capsule = shapes.capsule(awkward);
            const Box box = shapes.box(awkward);
            shapes.make_volumes(awkward, [&](const auto& shape) { volumes += loops.check_volume(shape); });
            const float max_distance = i % 3 == 0 ? std::numeric_limits<float>::infinity() : std::fabs(capsule.radius);
            distances += loops.check_distances(capsule, box, max_distance);
            moves.make_shapes(awkward, [&](const auto& moving, int) { sweeps += loops.check_sweep(moving); });
        }
    }
    const std::uint64_t asked = small_test_blobs().size() * scaled_share(30);
    CHECK(rays > asked / 5);
    CHECK(spheres > asked);
    CHECK(volumes > asked);
    CHECK(distances > asked / 5);
    CHECK(sweeps > asked / 5);
}

TEST_CASE("oracle: pairs that the loop leaves out do not change its answer") {
    const std::vector<TestBlob>& blobs = small_test_blobs();
    PairsFound found;
    for (const std::size_t i : sampled(blobs.size(), 3 * every_profile.size()))
        check_pair_loops(blobs[i], blobs[(i + 4) % blobs.size()], 1710 + i, scaled_share(2), found);
    // Most of a larger mesh is never placed.
    std::vector<const TestBlob*> few;
    for (const TestBlob& blob : blobs)
        if (blob.decoded.triangle_count <= 12) few.push_back(&blob);
    REQUIRE_FALSE(few.empty());
    const std::vector<TestBlob>& larger = medium_test_blobs();
    for (std::size_t i = 0; i < larger.size(); i += 4) {  // each profile twice
        const TestBlob& small = *few[i % few.size()];
        check_pair_loops(larger[i], small, 1810 + i, scaled_share(6), found);
        check_pair_loops(small, larger[i], 1910 + i, scaled_share(6), found);
    }
    CHECK(found.contacts > 0);
    CHECK(found.distances > 0);
}

}  // namespace
}  // namespace espalier::tests::triangle_loop_test
