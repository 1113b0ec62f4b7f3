// Claims about how far a query moves when it is rounded: the bound holds, in exact arithmetic, and is not far above
// what happens.
#include "support/testing.hpp"

#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/overlap/rounded_shapes.hpp>
#include <runtime/sweeps/round_sweep.hpp>

#include <Eigen/Geometry>

#include "oracle/exact_geometry.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::rounding_error_test {
namespace {

using oracle::Rational;

using Exact = oracle::Point;

Exact exact(const Vec3& v) { return Exact(Rational::of(v.x), Rational::of(v.y), Rational::of(v.z)); }
Rational square(const Exact& a) { return a.dot(a); }

/// A place in lattice steps, exactly.
Exact in_steps(const detail::BlobData& blob, const Vec3& world) {
    const Vec3 origin = {blob.origin[0], blob.origin[1], blob.origin[2]};
    return (exact(world) - exact(origin)) * Rational::of(1, -blob.step_exponent);
}
template <class Units>
Exact from_units(const Units& units, int fraction_bits) {
    return Exact(Rational(std::int64_t{units[0]}), Rational(std::int64_t{units[1]}), Rational(std::int64_t{units[2]})) *
           Rational::of(1, -fraction_bits);
}
Exact from_units(const detail::Integer3& units, int fraction_bits) {
    const std::int64_t all[3] = {units.x, units.y, units.z};
    return from_units(all, fraction_bits);
}

/// What was seen of one kind of query: the bound holds at each, and some come near it.
struct Held {
    std::uint64_t queries = 0, above_an_eighth = 0;

    /// The shape also grows or shrinks by `growth` steps.
    void check(const detail::BlobData& blob, const Result<float>& bound, const Rational& squared_move,
               const Rational& growth = Rational(0)) {
        REQUIRE(bound.status == QueryStatus::ok);
        const Rational steps = Rational::of(bound.value) * Rational::of(1, -blob.step_exponent) - growth;
        REQUIRE(steps.sign() >= 0);
        REQUIRE(squared_move <= steps * steps);
        ++queries;
        above_an_eighth += squared_move * Rational(64) >= steps * steps ? 1u : 0u;
    }
};

/// In the asset's box or around it, up to 2^`exponent` of its sizes away.
Vec3 some_place(const Blob& blob, Random& random, int exponent) {
    const float size = std::max(longest_side(blob.bounds()), std::ldexp(1.0f, blob.lattice().step_exponent));
    const auto away = static_cast<int>(random.below(static_cast<unsigned>(exponent + 1)));
    return sum(blob.bounds().min, random.in_cube(std::ldexp(size, away)));
}

constexpr int exponents[] = {0, 4, 12};

/// The square of how far a point of a sweep moves when it is rounded, at its start or at its end, whichever is more: in
/// between it moves by a mean of both. The point starts at `start` + `off`, which no float need hold.
Rational squared_move(const detail::BlobData& blob, const detail::LatticeSweep& sweep, const Vec3& start,
                      const Vec3& displacement, const detail::Integer3& rounded_start,
                      const Exact& off = Exact(0, 0, 0)) {
    Exact moved = in_steps(blob, start) - from_units(rounded_start, sweep.fraction_bits);
    const Rational per_unit = Rational::of(1, -blob.step_exponent);
    moved += off * per_unit;
    const Rational at_start = square(moved);
    moved += exact(displacement) * per_unit - from_units(sweep.displacement, sweep.fraction_bits);
    return std::max(at_start, square(moved));
}

detail::Integer3 point_of(const detail::HullSweep& sweep, unsigned i) {
    const auto& point = sweep.moving.point[i];
    return {point[0], point[1], point[2]};
}

/// How much a radius changes when it is rounded.
Rational growth(const detail::BlobData& blob, float radius, std::int64_t units, int fraction_bits) {
    const Rational change =
        Rational::of(radius) * Rational::of(1, -blob.step_exponent) - Rational::of(units, -fraction_bits);
    return change.sign() < 0 ? -change : change;
}

/// Calls function(blob, data, random) so often for each blob with triangles.
template <class Function>
void for_each_blob(std::uint64_t seed, int exponent, std::uint64_t count, const Function& function) {
    Random random(seed + static_cast<std::uint64_t>(exponent));
    for (const TestBlob& test : small_test_blobs())
        for (std::uint64_t i = 0; i < count && test.decoded.triangle_count != 0; ++i)
            function(test.opened.blob, detail::data_of(test.opened.blob), random);
}

void check_used(std::initializer_list<Held> all) {
    for (const Held& held : all) {
        CHECK(held.queries > 0);
        if (asks_enough()) CHECK(held.above_an_eighth > 0);
    }
}

TEST_CASE("rounding: no point or segment or volume moves farther than the error and some move an eighth as far") {
    for (const int exponent : exponents) {
        CAPTURE(exponent);
        Held points, segments, triangles, boxes;
        for_each_blob(
            2500, exponent, scaled_share(30), [&](const Blob& blob, const detail::BlobData& data, Random& random) {
                const Vec3 a = some_place(blob, random, exponent), b = some_place(blob, random, exponent);
                const Vec3 c = some_place(blob, random, exponent), places[3] = {a, b, c};
                detail::RoundedPoint point{};
                REQUIRE(detail::round_point(data, a, infinity, point) == QueryStatus::ok);
                points.check(data, rounding_error(blob, a),
                             square(in_steps(data, a) - from_units(point.origin, point.fraction_bits)));
                detail::RoundedSegment segment{};
                REQUIRE(detail::round_segment(data, {a, b}, segment) == QueryStatus::ok);
                const auto moved_end =
                    std::max(square(in_steps(data, a) - from_units(segment.from, segment.fraction_bits)),
                             square(in_steps(data, b) - from_units(segment.to, segment.fraction_bits)));
                segments.check(data, rounding_error(blob, Segment{a, b}), moved_end);
                detail::Rounded<Triangle> corners;
                const QueryStatus of_corners = detail::round_volume(data, Triangle{a, b, c}, corners);
                REQUIRE(!is_refused(of_corners));
                if (of_corners == QueryStatus::ok) {
                    Rational most;
                    for (int k = 0; k < 3; ++k)
                        most = std::max(most, square(in_steps(data, places[k]) -
                                                     from_units(corners.triangle.corner[k], corners.fraction_bits)));
                    triangles.check(data, rounding_error(blob, Triangle{a, b, c}), most);
                }
                const OrientedBox world = {a, {difference(b, a), difference(c, a), {a.x - c.z, b.y - c.x, c.z - a.y}}};
                detail::Rounded<OrientedBox> box;
                const QueryStatus status = detail::round_volume(data, world, box);
                if (is_refused(status)) REQUIRE(rounding_error(blob, world).status == status);
                if (status != QueryStatus::ok) return;
                Rational most;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    Exact moved = in_steps(data, world.center) - from_units(box.center, box.fraction_bits);
                    for (unsigned half = 0; half < 3; ++half) {
                        const Exact change = exact(world.half_axes[half]) * Rational::of(1, -data.step_exponent) -
                                             from_units(box.half[half], box.fraction_bits);
                        moved += (corner >> half & 1u) != 0 ? change : Exact(-change);
                    }
                    most = std::max(most, square(moved));
                }
                boxes.check(data, rounding_error(blob, world), most);
            });
        check_used({points, segments, triangles, boxes});
    }
}

TEST_CASE("rounding: no sweep moves farther than the error and some move an eighth as far") {
    for (const int exponent : exponents) {
        CAPTURE(exponent);
        Held spheres, capsules, boxes, turned, hulls;
        for_each_blob(
            2650, exponent, scaled_share(30), [&](const Blob& blob, const detail::BlobData& data, Random& random) {
                const Vec3 a = some_place(blob, random, exponent), b = some_place(blob, random, exponent);
                const Vec3 c = some_place(blob, random, exponent), d = some_place(blob, random, exponent);
                const Vec3 way = difference(c, d);
                const float radius = std::abs(d.x - b.x);
                // Refused are sweeps beyond 2^34 steps, which few of these reach.
                const auto is_answered = [&](const auto& shape, auto& sweep) {
                    const QueryStatus status = detail::round_sweep(data, shape, way, sweep);
                    REQUIRE(rounding_error(blob, shape, way).status == status);
                    return status == QueryStatus::ok;
                };
                const Sphere sphere = {a, radius};
                detail::CapsuleSweep ball;
                if (is_answered(sphere, ball))
                    spheres.check(data, rounding_error(blob, sphere, way), squared_move(data, ball, a, way, ball.from),
                                  growth(data, radius, ball.moving.sphere.radius, ball.fraction_bits));
                const Capsule capsule = {a, b, radius};
                detail::CapsuleSweep pill;
                if (is_answered(capsule, pill))
                    capsules.check(data, rounding_error(blob, capsule, way),
                                   std::max(squared_move(data, pill, a, way, pill.from),
                                            squared_move(data, pill, b, way, pill.from + pill.moving.axis)),
                                   growth(data, radius, pill.moving.sphere.radius, pill.fraction_bits));
                const std::array<Vec3, 4> vertices = {a, b, c, d};
                detail::HullSweep hull;
                if (is_answered(ConvexHull{vertices}, hull)) {
                    Rational most;
                    for (unsigned vertex = 0; vertex < 4; ++vertex)
                        most = std::max(most, squared_move(data, hull, vertices[vertex], way, point_of(hull, vertex)));
                    hulls.check(data, rounding_error(blob, ConvexHull{vertices}, way), most);
                }
                const OrientedBox world = {a, {difference(b, a), difference(c, a), {a.x - c.z, b.y - c.x, c.z - a.y}}};
                if (is_answered(world, hull)) {
                    Rational most;
                    for (unsigned corner = 0; corner < 8; ++corner) {
                        Exact off(0, 0, 0);
                        for (unsigned half = 0; half < 3; ++half) {
                            const Exact along = exact(world.half_axes[half]);
                            off += (corner >> half & 1u) != 0 ? along : Exact(-along);
                        }
                        most = std::max(most, squared_move(data, hull, a, way, point_of(hull, corner), off));
                    }
                    turned.check(data, rounding_error(blob, world, way), most);
                }
                detail::BoxSweep box;
                if (!is_answered(Box{a, b}, box)) return;
                Rational most;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    const auto either = [corner](unsigned axis, auto low, auto high) {
                        return (corner >> axis & 1u) != 0 ? high : low;
                    };
                    const Vec3 at = {either(0, a.x, b.x), either(1, a.y, b.y), either(2, a.z, b.z)};
                    const detail::Integer3 units = {either(0, box.low.x, box.high.x), either(1, box.low.y, box.high.y),
                                                    either(2, box.low.z, box.high.z)};
                    most = std::max(most, squared_move(data, box, at, way, units));
                }
                boxes.check(data, rounding_error(blob, Box{a, b}, way), most);
            });
        check_used({spheres, capsules, boxes, turned, hulls});
    }
}

TEST_CASE("rounding: the error of a sweep is refused where the sweep is") {
    const OpenedBlob opened(make_cube(0.0f, 1.0f));
    const Blob& blob = opened.blob;
    const float step = std::ldexp(1.0f, blob.lattice().step_exponent);
    Random random(2660);
    std::uint64_t refused = 0;
    const auto compare = [&](const auto& shape, const Vec3& way) {
        const Result<float> moved = rounding_error(blob, shape, way);
        const QueryStatus expected = sweep(blob, shape, way).status;
        REQUIRE(moved.status == (is_refused(expected) ? expected : QueryStatus::ok));
        REQUIRE((moved ? moved.value > 0.0f : moved.value == 0.0f));
        refused += moved ? 0u : 1u;
    };
    for (std::uint64_t i = 0; i < scaled(1000); ++i) {
        const Vec3 a = some_point(blob, random), b = some_point(blob, random), way = some_point(blob, random);
        compare(Sphere{a, some_length(blob, random)}, way);
        compare(Capsule{a, b, some_length(blob, random)}, way);
        compare(Box{a, b}, way);
        compare(OrientedBox{a, {b, way, a}}, way);
        const std::array<Vec3, 2> vertices = {a, b};
        compare(ConvexHull{vertices}, way);
    }
    if (asks_enough()) CHECK(refused > 0);
    const Sphere ball = {{0.5f, 0.5f, 0.5f}, 0.25f};
    CHECK(rounding_error(blob, ball, {0x1p34f * step, 0.0f, 0.0f}).status == QueryStatus::out_of_range);
    CHECK(rounding_error(blob, ball, {0x1p33f * step, 0.0f, 0.0f}).status == QueryStatus::ok);
    CHECK(rounding_error(Blob(), ball, {}).status == QueryStatus::not_open);
    const OpenedBlob empty(Mesh{});
    CHECK(rounding_error(empty.blob, ball, {}).status == QueryStatus::ok);
    CHECK(rounding_error(empty.blob, ball, {}).value == 0.0f);
    CHECK(rounding_error(empty.blob, Sphere{{}, -1.0f}, {}).status == QueryStatus::invalid_argument);
    // Place, displacement and radius by half of 2^-6 steps each, in a cube of one unit at the origin.
    const float moved = rounding_error(blob, ball, {}).value;
    CHECK(moved >= (2.0f * 1.7320508f + 1.0f) * step / 128.0f);
    CHECK(moved <= (3.0f * 1.7320508f + 1.0f) * step / 128.0f);
}

TEST_CASE("rounding: no ray moves farther than the error and some move an eighth as far") {
    for (const int exponent : {0, 4, 12, 20}) {
        CAPTURE(exponent);
        Held rays;
        for_each_blob(
            2600, exponent, scaled_share(100), [&](const Blob& blob, const detail::BlobData& data, Random& random) {
                const Vec3 from = some_place(blob, random, exponent), to = some_place(blob, random, 0);
                const Ray world = {.origin = from, .direction = difference(to, from)};
                detail::LatticeRay ray;
                if (!detail::round_ray(data, world, ray)) return;
                const Exact origin = in_steps(data, from), way = exact(world.direction);
                const Exact rounded_origin = from_units(ray.origin, ray.fraction_bits);
                Rational most;
                for (int k = 0; k < 3; ++k) {
                    if (ray.direction[k] == 0) continue;
                    for (const std::int64_t plane : {std::int64_t{0}, std::int64_t{data.extent[k]}}) {
                        const Rational tau =
                            (Rational(plane) - rounded_origin[k]) / Rational(std::int64_t{ray.direction[k]});
                        if (tau.sign() < 0) continue;
                        Exact place = rounded_origin;
                        bool is_in_box = true;
                        for (int j = 0; j < 3; ++j) {
                            place[j] += tau * Rational(std::int64_t{ray.direction[j]});
                            is_in_box =
                                is_in_box && place[j].sign() >= 0 && place[j] <= Rational(std::int64_t{data.extent[j]});
                        }
                        if (is_in_box) most = std::max(most, square((place - origin).cross(way)) / square(way));
                    }
                }
                rays.check(data, rounding_error(blob, world), most);
            });
        check_used({rays});
    }
}

TEST_CASE("rounding: the error in a unit box of 16 bits and of shapes made of points") {
    const OpenedBlob opened(make_cube(0.0f, 1.0f));
    const Blob& blob = opened.blob;
    REQUIRE(blob.max_error() == 0.0f);
    const Result<float> moved = rounding_error(blob, Vec3{0.3f, 0.4f, 0.5f});
    REQUIRE(moved);
    CHECK(moved.value >= 1.7320508f * std::ldexp(1.0f, blob.lattice().step_exponent) / 128.0f);
    CHECK(moved.value <= 1.7320508f * std::ldexp(1.0f, blob.lattice().step_exponent) / 96.0f);
    const Vec3 a = {0.25f, 0.5f, 1.5f}, b = {7.0f, -3.0f, 0.1f};
    CHECK(rounding_error(blob, Sphere{a, 0.5f}).value == rounding_error(blob, a).value);
    CHECK(rounding_error(blob, Capsule{a, b, 0.5f}).value == rounding_error(blob, Segment{a, b}).value);
    CHECK(rounding_error(blob, Box{b, a}).value == rounding_error(blob, Segment{b, a}).value);
}

TEST_CASE("rounding: the error of what is no query is refused and of an empty blob it is zero") {
    const OpenedBlob opened(make_cube(0.0f, 1.0f));
    const Blob& blob = opened.blob;
    const Vec3 origin = {0.0f, 0.0f, 0.0f}, nowhere = {0.0f, not_a_number, 0.0f}, far = {1e30f, 0.0f, 0.0f};
    const auto status_of = [&](const auto& shape) { return rounding_error(blob, shape).status; };
    CHECK(status_of(nowhere) == QueryStatus::invalid_argument);
    CHECK(status_of(Sphere{origin, -1.0f}) == QueryStatus::invalid_argument);
    CHECK(status_of(Sphere{origin, not_a_number}) == QueryStatus::invalid_argument);
    CHECK(status_of(Capsule{origin, nowhere, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status_of(Capsule{nowhere, origin, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status_of(Capsule{origin, origin, -1.0f}) == QueryStatus::invalid_argument);
    CHECK(status_of(Box{origin, {infinity, 1.0f, 1.0f}}) == QueryStatus::invalid_argument);
    CHECK(status_of(OrientedBox{origin, {origin, nowhere, origin}}) == QueryStatus::invalid_argument);
    CHECK(status_of(Triangle{origin, origin, nowhere}) == QueryStatus::invalid_argument);
    CHECK(status_of(Triangle{nowhere, origin, origin}) == QueryStatus::invalid_argument);
    CHECK(status_of(Ray{.origin = nowhere, .direction = {1.0f, 0.0f, 0.0f}}) == QueryStatus::invalid_argument);
    CHECK(status_of(Ray{.origin = origin, .direction = nowhere}) == QueryStatus::invalid_argument);
    CHECK(status_of(Ray{.origin = origin, .direction = origin}) == QueryStatus::invalid_argument);
    CHECK(status_of(far) == QueryStatus::out_of_range);
    CHECK(status_of(Segment{origin, far}) == QueryStatus::out_of_range);
    CHECK(status_of(OrientedBox{origin, {far, far, far}}) == QueryStatus::out_of_range);
    CHECK(status_of(Ray{.origin = far, .direction = {-1.0f, 0.0f, 0.0f}}) == QueryStatus::ok);
    CHECK(status_of(Ray{.origin = {0.0f, -3e38f, 0.0f}, .direction = far}) == QueryStatus::out_of_range);
    CHECK(rounding_error(Blob(), Vec3{1.0f, 2.0f, 3.0f}).status == QueryStatus::not_open);
    const OpenedBlob empty(Mesh{});
    const Result<float> of_nothing = rounding_error(empty.blob, Vec3{1.0f, 2.0f, 3.0f});
    CHECK(of_nothing.status == QueryStatus::ok);
    CHECK(of_nothing.value == 0.0f);
    Random random(2700);
    for (std::uint64_t i = 0; i < scaled(2000); ++i) {
        const Vec3 a = some_point(blob, random), b = some_point(blob, random), c = some_point(blob, random);
        const float length = some_length(blob, random);
        for (const Result<float>& result :
             {rounding_error(blob, a), rounding_error(blob, Sphere{a, length}),
              rounding_error(blob, Capsule{a, b, length}), rounding_error(blob, Box{a, b}),
              rounding_error(blob, OrientedBox{a, {a, b, c}}), rounding_error(blob, Triangle{a, b, c}),
              rounding_error(blob, Ray{.origin = a, .direction = b})})
            REQUIRE((result.status == QueryStatus::ok ? result.value > 0.0f : result.value == 0.0f));
    }
}

}  // namespace
}  // namespace espalier::tests::rounding_error_test
