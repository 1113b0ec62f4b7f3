// Claims about transforms: how far they are from real arithmetic, and that their bits depend on nothing else.
#include "support/testing.hpp"

#include "oracle/surfaces.hpp"
#include "support/base/answer_hash.hpp"
#include "support/machine/float_mode.hpp"

namespace espalier::tests::transform_test {
namespace {

// Doubles have 29 bits more than the floats that are judged.
using reference::Point;
using reference::to_point;

/// By the formula v + 2 w (u x v) + 2 u x (u x v) of a unit quaternion (u, w).
Point rotated(const Quaternion& q, const Point& v, double direction) {
    Point u = to_point(Vec3{q.x, q.y, q.z});
    const double w = static_cast<double>(q.w), length = std::sqrt(dot(u, u) + w * w);
    u = (direction / length) * u;
    const Point turned = cross(u, v);
    return v + (2.0 * w / length) * turned + 2.0 * cross(u, turned);
}
Point exactly_to_world(const Transform& t, const Point& p) {
    return rotated(t.rotation, static_cast<double>(t.scale) * p, 1.0) + to_point(t.translation);
}
Point exactly_to_local(const Transform& t, const Point& p) {
    return (1.0 / static_cast<double>(t.scale)) * rotated(t.rotation, p - to_point(t.translation), -1.0);
}
double error(const Vec3& v, const Point& exact) {
    const Point off = to_point(v) - exact;
    return std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
}

// Arguments of one call would be evaluated in any order.
float any_size(Random& random, int most) {
    const int exponent = random.between(-most, most);
    return std::ldexp(random.signed_unit(), exponent);
}
Vec3 any_point(Random& random, int most) {
    return {any_size(random, most), any_size(random, most), any_size(random, most)};
}
Transform any_transform(Random& random, int most) {
    Transform result;
    const auto component = [&] { return random.below(4) == 0 ? any_size(random, 30) : random.signed_unit(); };
    result.rotation = {component(), component(), component(), component()};
    if (random.below(8) == 0) result.rotation = {0, random.coin() ? 1.0f : 0.0f, 0, 1};
    result.translation = any_point(random, most);
    const int exponent = random.between(-most, most);
    result.scale = std::ldexp(1.0f + random.unit(), exponent);
    return result;
}

bool is_nan(const Vec3& v) { return std::isnan(v.x) && std::isnan(v.y) && std::isnan(v.z); }

/// The arguments of every call.
struct Arguments {
    Transform t, inner;
    Vec3 p, q, d;
    float radius;
    Box box;

    Arguments(Random& random, int most)
        : t(any_transform(random, most)),
          inner(any_transform(random, most)),
          p(any_point(random, most)),
          q(any_point(random, most)),
          d(any_point(random, most)),
          radius(any_size(random, most)),
          box{{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)},
              {std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)}} {}
};

/// The bits that every call returns, but those of NaN.
[[gnu::noinline]] std::uint64_t hash_of_everything(const Arguments& arguments) {
    const auto& [t, inner, p, q, d, radius, axis_aligned] = arguments;
    AnswerHash hash;
    const auto add = [&hash](float x) {
        if (!std::isnan(x)) hash.add(x);
    };
    const auto add_point = [&](const Vec3& v) { add(v.x), add(v.y), add(v.z); };
    add_point(to_local(t, p));
    add_point(to_world(t, p));
    add_point(direction_to_local(t, d));
    add_point(direction_to_world(t, d));
    const Capsule capsule = to_local(t, Capsule{p, q, radius});
    add_point(capsule.from), add_point(capsule.to), add(capsule.radius);
    const OrientedBox box = to_local(t, axis_aligned);
    add_point(box.center);
    for (const Vec3& axis : box.half_axes) add_point(axis);
    const Plane plane = to_local(t, Plane{d, radius});
    add_point(plane.normal), add(plane.offset);
    const Transform relative = to_local(t, inner);
    for (const float c : {relative.rotation.x, relative.rotation.y, relative.rotation.z, relative.rotation.w}) add(c);
    add_point(relative.translation), add(relative.scale);
    add_point(translated(p, d));
    // A matrix of columns that are perpendicular up to rounding.
    const Vec3 columns[3] = {direction_to_world(t, {1, 0, 0}), direction_to_world(t, {0, 1, 0}),
                             direction_to_world(t, {0, 0, 1})};
    const float rows[3][4] = {{columns[0].x, columns[1].x, columns[2].x, p.x},
                              {columns[0].y, columns[1].y, columns[2].y, p.y},
                              {columns[0].z, columns[1].z, columns[2].z, p.z}};
    const Result<Transform> of_matrix = transform_from_matrix(rows);
    hash.add(static_cast<std::uint32_t>(of_matrix.status));
    add(of_matrix.value.rotation.x), add(of_matrix.value.rotation.w), add(of_matrix.value.scale);
    return hash.value();
}

TEST_CASE("transform: points move within the stated error of real arithmetic") {
    Random random(1);
    double worst = 0.0;
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        const Transform t = any_transform(random, 20);
        const Vec3 p = any_point(random, 20);
        const double scale = static_cast<double>(t.scale);
        const Point world = exactly_to_world(t, to_point(p)), local = exactly_to_local(t, to_point(p));
        const double world_unit = 0x1p-19 * scale * length(to_point(p)) + 0x1p-24 * length(world);
        const double local_unit = 0x1p-19 * length(to_point(p) - to_point(t.translation)) / scale;
        worst = std::max({worst, error(to_world(t, p), world) / world_unit, error(to_local(t, p), local) / local_unit});
        const Transform turn = {t.rotation, {}, t.scale};
        const double size = length(to_point(p));
        worst = std::max(
            {worst, error(direction_to_world(t, p), exactly_to_world(turn, to_point(p))) / (0x1p-19 * scale * size),
             error(direction_to_local(t, p), exactly_to_local(turn, to_point(p))) / (0x1p-19 * size / scale)});
        const Transform rotation = {t.rotation, {}, 1.0f};
        worst =
            std::max(worst, error(normal_to_world(t, p), exactly_to_world(rotation, to_point(p))) / (0x1p-19 * size));
    }
    MESSAGE("largest error, of the stated one: ", worst);
    CHECK(worst < 1.0);
    CHECK(worst > 0.05);
}

TEST_CASE("transform: shapes move as their points do") {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Transform t = any_transform(random, 10);
        const Vec3 p = any_point(random, 10), q = any_point(random, 10), r = any_point(random, 10);
        const float radius = random.unit();
        const Vec3 local_p = to_local(t, p), local_q = to_local(t, q), local_r = to_local(t, r);
        const Segment segment = to_local(t, Segment{p, q});
        CHECK((segment.from == local_p && segment.to == local_q));
        const Sphere sphere = to_local(t, Sphere{p, radius});
        CHECK((sphere.center == local_p && sphere.radius == radius / t.scale));
        const Capsule capsule = to_local(t, Capsule{p, q, radius});
        CHECK((capsule.from == local_p && capsule.to == local_q && capsule.radius == radius / t.scale));
        const Triangle triangle = to_local(t, Triangle{p, q, r});
        CHECK((triangle.a == local_p && triangle.b == local_q && triangle.c == local_r));
        const Ray ray = to_local(t, Ray{p, q, 0.5f, 7.0f, FaceCulling::back});
        CHECK((ray.origin == local_p && ray.direction == direction_to_local(t, q)));
        CHECK((ray.t_min == 0.5f && ray.t_max == 7.0f && ray.culling == FaceCulling::back));
        const OrientedBox oriented = to_local(t, OrientedBox{p, {q, r, p}});
        CHECK(oriented.center == local_p);
        CHECK(oriented.half_axes[1] == direction_to_local(t, r));
        const Cone cone = to_local(t, Cone{p, q, radius});
        CHECK((cone.apex == local_p && cone.axis == direction_to_local(t, q) && cone.radius == radius / t.scale));
        const Transform rotation = {t.rotation, {}, 1.0f};
        CHECK(normal_to_world(t, q) == direction_to_world(rotation, q));
    }
}

TEST_CASE("transform: a box becomes the oriented box with the same corners") {
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const Transform t = any_transform(random, 8);
        const Vec3 low = any_point(random, 8);
        const Vec3 high = {low.x + random.unit(), low.y + random.unit(), low.z + random.unit()};
        const OrientedBox box = to_local(t, Box{low, high});
        for (unsigned corner = 0; corner < 8; ++corner) {
            const Point exact =
                exactly_to_local(t, to_point(Vec3{corner & 1u ? high.x : low.x, corner & 2u ? high.y : low.y,
                                                  corner & 4u ? high.z : low.z}));
            Point of_box = to_point(box.center);
            for (unsigned k = 0; k < 3; ++k)
                of_box = of_box + ((corner >> k & 1u) != 0 ? 1.0 : -1.0) * to_point(box.half_axes[k]);
            const double size =
                (length(to_point(low)) + length(to_point(t.translation)) + 2.0) / static_cast<double>(t.scale);
            CHECK(length(of_box - exact) <= 0x1p-18 * size);
        }
    }
    CHECK(is_nan(to_local({}, Box{{1, 1, 1}, {0, 0, 0}}).center));
    CHECK(is_nan(to_local({}, Box{{0, 0, 0}, {infinity, infinity, infinity}}).center));
}

TEST_CASE("transform: a plane keeps the same points on its inner side") {
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const Transform t = any_transform(random, 8);
        const Plane plane = {any_point(random, 8), any_size(random, 8)};
        const Plane moved = to_local(t, plane);
        const Vec3 local = any_point(random, 8);
        const double scale = static_cast<double>(t.scale), size = length(to_point(plane.normal));
        const double inside = static_cast<double>(moved.offset) - dot(to_point(moved.normal), to_point(local));
        const double expected =
            (static_cast<double>(plane.offset) - dot(to_point(plane.normal), exactly_to_world(t, to_point(local)))) /
            scale;
        const double bound =
            2.0 * 0x1p-19 * size * length(to_point(local)) +
            0x1p-21 * (size * length(to_point(t.translation)) + std::abs(static_cast<double>(plane.offset))) / scale;
        CHECK(std::abs(inside - expected) <= bound);
    }
}

TEST_CASE("transform: the default changes no bit") {
    for (const float x : {0.0f, -0.0f, 1.0f, -3.5f, std::numeric_limits<float>::denorm_min(), infinity, not_a_number}) {
        const Vec3 p = {x, -x, x};
        CHECK(same_bits(to_local({}, p), p));
        CHECK(same_bits(to_world({}, p), p));
        CHECK(same_bits(direction_to_local({}, p), p));
        CHECK(same_bits(direction_to_world({}, p), p));
        CHECK(same_bits(normal_to_world({}, p), p));
        CHECK(same_bits(to_local({}, Sphere{p, x}).radius, x));
    }
    const Transform t = {{0.5f, 0, 0, std::numeric_limits<float>::denorm_min()}, {-0.0f, 1, 2}, 1e30f};
    CHECK(to_local({}, t) == t);
}

TEST_CASE("transform: rotations by quarter turns round nothing") {
    const Vec3 p = {0.1f, 1e6f / 3, -7e-5f};
    CHECK(to_world({{0, 0, 1, 1}, {}, 1}, p) == Vec3{-p.y, p.x, p.z});
    CHECK(to_local({{0, 0, 1, 1}, {}, 1}, p) == Vec3{p.y, -p.x, p.z});
    CHECK(to_world({{-3, 0, 0, 3}, {}, 1}, p) == Vec3{p.x, p.z, -p.y});
    CHECK(to_world({{0, 1e-20f, 0, 0}, {}, 1}, p) == Vec3{-p.x, p.y, -p.z});
    CHECK(to_world({{1, 1, 1, 1}, {}, 1}, p) == Vec3{p.z, p.x, p.y});
    CHECK(to_world({{}, {1, 2, 3}, 2}, {1, 1, 1}) == Vec3{3, 4, 5});
    CHECK(to_local({{}, {1, 2, 3}, 2}, Vec3{3, 4, 5}) == Vec3{1, 1, 1});
}

TEST_CASE("transform: an invalid transform gives NaN") {
    const Transform invalid[] = {{{0, 0, 0, 0}, {}, 1},
                                 {{not_a_number, 0, 0, 1}, {}, 1},
                                 {{infinity, 0, 0, 1}, {}, 1},
                                 {{}, {}, 0},
                                 {{}, {}, -1},
                                 {{}, {}, not_a_number},
                                 {{}, {}, infinity},
                                 {{}, {}, 0x1p-101f},
                                 {{}, {}, 0x1p101f},
                                 {{}, {not_a_number, not_a_number, not_a_number}, 1}};
    for (const Transform& t : invalid) {
        CHECK(is_nan(to_local(t, Vec3{1, 2, 3})));
        CHECK(is_nan(to_world(t, {1, 2, 3})));
    }
    CHECK(is_nan(normal_to_world({{0, 0, 0, 0}, {}, 1}, {1, 2, 3})));
    CHECK(normal_to_world({{0, 0, 1, 1}, {5, 6, 7}, 9}, {0, 0, 0}) == Vec3{0, 0, 0});
    CHECK(std::isnan(to_local({{}, {}, 0x1p100f}, Transform{{}, {}, 0x1p-1f}).scale));
}

TEST_CASE("transform: a transform in another leads to the same place") {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const Transform outer = any_transform(random, 8), inner = any_transform(random, 8);
        const Transform relative = to_local(outer, inner);
        const Vec3 p = any_point(random, 8);
        const Point exact = exactly_to_local(outer, exactly_to_world(inner, to_point(p)));
        const double size = (static_cast<double>(inner.scale) * length(to_point(p)) +
                             length(to_point(inner.translation) - to_point(outer.translation))) /
                            static_cast<double>(outer.scale);
        CHECK(length(exactly_to_world(relative, to_point(p)) - exact) <= 0x1p-18 * size);
    }
}

TEST_CASE("transform: moving by a displacement adds it to every point") {
    const Vec3 d = {1, -2, 0.5f};
    CHECK(translated(Vec3{1, 2, 3}, d) == Vec3{2, 0, 3.5f});
    CHECK(translated(Segment{{}, {1, 2, 3}}, d).to == Vec3{2, 0, 3.5f});
    CHECK(translated(Sphere{{}, 7}, d).radius == 7.0f);
    CHECK(translated(Capsule{{}, {1, 2, 3}, 7}, d).from == d);
    CHECK(translated(Triangle{{}, {}, {1, 2, 3}}, d).c == Vec3{2, 0, 3.5f});
    CHECK(translated(Box{{}, {1, 2, 3}}, d).max == Vec3{2, 0, 3.5f});
    CHECK(translated(OrientedBox{{}, {{1, 0, 0}, {}, {}}}, d).half_axes[0] == Vec3{1, 0, 0});
    CHECK(translated(Ray{{}, {1, 2, 3}}, d).direction == Vec3{1, 2, 3});
    const Cone cone = translated(Cone{{1, 2, 3}, {4, 5, 6}, 7}, d);
    CHECK((cone.apex == Vec3{2, 0, 3.5f} && cone.axis == Vec3{4, 5, 6} && cone.radius == 7.0f));
}

TEST_CASE("transform: a matrix of a rotation and a scale gives its transform") {
    constexpr Point axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    Random random(6);
    double worst = 0.0;
    for (std::uint64_t i = 0; i < scaled(5'000); ++i) {
        const Transform t = any_transform(random, 30);
        const double scale = static_cast<double>(t.scale);
        float rows[3][4];
        for (int k = 0; k < 3; ++k) {
            const Point column = rotated(t.rotation, scale * axes[k], 1.0);
            rows[0][k] = static_cast<float>(column.x);
            rows[1][k] = static_cast<float>(column.y);
            rows[2][k] = static_cast<float>(column.z);
        }
        rows[0][3] = t.translation.x, rows[1][3] = t.translation.y, rows[2][3] = t.translation.z;
        const Result<Transform> result = transform_from_matrix(rows);
        REQUIRE(result);
        CHECK(result->translation == t.translation);
        for (int k = 0; k < 3; ++k) {
            const Transform no_move = {result->rotation, {}, result->scale};
            const Point column = exactly_to_world(no_move, axes[k]);
            worst = std::max(worst, error({rows[0][k], rows[1][k], rows[2][k]}, column) / (0x1p-20 * scale));
        }
    }
    MESSAGE("largest error, of the stated one: ", worst);
    CHECK(worst < 1.0);
    const float identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    CHECK(transform_from_matrix(identity).value == Transform{});
}

TEST_CASE("transform: matrices of shear and mirrors and unequal scale are refused") {
    using Rows = float[3][4];
    const auto status = [](const Rows& rows) { return transform_from_matrix(rows).status; };
    CHECK(status({{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0.001f, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0, 0, 0}, {0, 1, 0, 0}, {0.001f, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0, 0, 0}, {0, 1, 0.001f, 0}, {0, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0, 0, 0}, {0, 1.001f, 0, 0}, {0, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, not_a_number, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0, 0, infinity}, {0, 1, 0, 0}, {0, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{infinity, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}) == QueryStatus::invalid_argument);
    CHECK(status({{1, 0x1p-15f, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}) == QueryStatus::ok);
    CHECK(status({{0x1p101f, 0, 0, 0}, {0, 0x1p101f, 0, 0}, {0, 0, 0x1p101f, 0}}) == QueryStatus::out_of_range);
    CHECK(status({{0x1p-101f, 0, 0, 0}, {0, 0x1p-101f, 0, 0}, {0, 0, 0x1p-101f, 0}}) == QueryStatus::out_of_range);
    CHECK(status({{1e-45f, 0, 0, 0}, {0, 1e-45f, 0, 0}, {0, 0, 1e-45f, 0}}) == QueryStatus::out_of_range);
    CHECK(transform_from_matrix({{3, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 3, 0}}).value == Transform{{}, {}, 3});
}

TEST_CASE("transform: no mode of the processor changes a bit") {
    for (const int most : {4, 100, 126, 140}) {
        Random random(static_cast<std::uint64_t>(most));
        for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
            const Arguments arguments(random, most);
            const std::uint64_t expected = hash_of_everything(arguments);
            for (const unsigned flags : float_modes) {
                const FloatMode mode(flags);
                CHECK(hash_of_everything(arguments) == expected);
            }
        }
    }
}

TEST_CASE("transform: results have the same bits on every machine") {
    Random random(8);
    AnswerHash all;
    for (int i = 0; i < 1000; ++i) {
        const std::uint64_t hash = hash_of_everything(Arguments(random, 20));
        all.add(static_cast<std::uint32_t>(hash)), all.add(static_cast<std::uint32_t>(hash >> 32));
    }
    CHECK(all.value() == 0x632BD13ECE46C34Bu);
}

}  // namespace
}  // namespace espalier::tests::transform_test
