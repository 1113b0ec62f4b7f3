// Tests that rounding_error returns the bounds that docs/numerics.md derives (section 2), and refuses where it ends.
#include "support/testing.hpp"

namespace espalier::tests::rounding_formula_test {
namespace {

constexpr float extent = 8.0f;  // of the blob, whose lattice has the whole numbers

/// The coordinates of a shape.
struct Shape {
    float largest = 0.0f, reach = 0.0f;

    Shape& add(const Vec3& point, float spread = 0.0f) {
        for (const float at : {point.x, point.y, point.z}) {
            largest = std::max(largest, std::fabs(at));
            reach = std::max(reach, std::max(std::fabs(at), std::fabs(extent - at)) + spread);
        }
        return *this;
    }
    /// How far along an axis a sum of so many rounded vectors moves.
    [[nodiscard]] double moves(int grid, int terms) const {
        const double half_grid = std::ldexp(1.0, -std::clamp(grid - std::ilogb(reach), 0, 6) - 1);
        return terms * half_grid + (double(largest) + terms) * 0x1p-24;
    }
    [[nodiscard]] double moves_as_ray() const {
        if (reach < 0x1p23f) return moves(23, 1) + double(reach) * 0x1p-24;
        return 0.5 + 6.0 * (double(largest) + 2.0 * double(extent) + 1.0) * 0x1p-24;
    }
};

/// Requires the distance in space, rounded up by little more than float32 needs.
void require_distance(const Result<float>& moved, double along_an_axis) {
    REQUIRE(moved.status == QueryStatus::ok);
    REQUIRE(double(moved.value) >= along_an_axis * std::sqrt(3.0));
    REQUIRE(double(moved.value) <= along_an_axis * std::sqrt(3.0) * (1.0 + 0x1.4p-22));
}

void require_bound(const Result<float>& moved, const Shape& shape, int grid, int terms) {
    if (shape.reach < 0x1p36f) return require_distance(moved, shape.moves(grid, terms));
    REQUIRE(moved.status == QueryStatus::out_of_range);
    REQUIRE(moved.value == 0.0f);
}

TEST_CASE("rounding: the error is the documented bound at every distance") {
    const OpenedBlob opened(make_cube(0.0f, extent), {.resolution = Resolution::step(0)});
    const Blob& blob = opened.blob;
    Random random(2710);
    for (int exponent = 2; exponent <= 40; ++exponent) {
        const float power = std::ldexp(1.0f, exponent);
        for (const float size : {power, std::nextafter(power, 0.0f), std::nextafter(power, 2.0f * power),
                                 power * (1.0f + random.unit())}) {
            for (const float along : {size, -size, extent - size}) {
                const unsigned axis = random.below(3);
                const auto place = [&](unsigned k, float coordinate) {
                    float at[3] = {3.0f, 2.0f + random.unit(), 5.0f};
                    at[k % 3] = coordinate;
                    return Vec3{at[0], at[1], at[2]};
                };
                const Vec3 near = place(axis, 4.0f), far = place(axis, along), turned = place(axis + 1, along);
                const Shape point = Shape().add(far), segment = Shape().add(near).add(far);
                const Shape triangle = Shape().add(near).add(far).add(turned);
                require_bound(rounding_error(blob, far), point, 23, 1);
                require_bound(rounding_error(blob, Segment{near, far}), segment, 35, 1);
                require_bound(rounding_error(blob, Segment{far, near}), segment, 35, 1);
                require_bound(rounding_error(blob, Triangle{near, far, turned}), triangle, 22, 1);
                require_bound(rounding_error(blob, Triangle{turned, near, far}), triangle, 22, 1);
                require_distance(rounding_error(blob, Ray{.origin = far, .direction = {1.0f, 2.0f, 3.0f}}),
                                 point.moves_as_ray());
                // Two half axes along one axis, another along the next.
                OrientedBox box = {near, {{}, {}, {}}};
                float* const ends[3] = {&box.half_axes[0].x, &box.half_axes[0].y, &box.half_axes[0].z};
                *ends[axis] = 0.75f * along;
                box.half_axes[1] = {-box.half_axes[0].x / 3.0f, -box.half_axes[0].y / 3.0f, -box.half_axes[0].z / 3.0f};
                box.half_axes[2] = {box.half_axes[1].z, box.half_axes[1].x, box.half_axes[1].y};
                const float spread = 0.75f * std::fabs(along) + 0.75f * std::fabs(along) / 3.0f;
                require_bound(rounding_error(blob, box), Shape().add(near, spread), 22, 4);
            }
        }
    }
}

TEST_CASE("rounding: a ray from 2^120 steps away is out of range and from just before it is not") {
    const OpenedBlob opened(make_cube(0.0f, extent), {.resolution = Resolution::step(0)});
    for (const float sign : {-1.0f, 1.0f}) {
        const auto status_from = [&](float x) {
            const Ray ray = {.origin = {0.0f, sign * x, 0.0f}, .direction = {1.0f, 2.0f, 3.0f}};
            return rounding_error(opened.blob, ray).status;
        };
        CHECK(status_from(0x1p120f) == QueryStatus::out_of_range);
        CHECK(status_from(std::nextafter(0x1p120f, 0.0f)) == QueryStatus::ok);
    }
}

}  // namespace
}  // namespace espalier::tests::rounding_formula_test
