// No ray gets out of a closed mesh: not through a vertex, not through a side, on no instruction set.
#include "support/testing.hpp"

#include "support/machine/instruction_paths.hpp"

#include <numbers>

namespace espalier::tests::leak_test {
namespace {

/// Closed, with a point inside that the test knows.
struct ClosedShape {
    std::string name;
    OpenedBlob opened;
    DecodedBlob decoded;
    /// A point well inside, in lattice steps.
    GridPoint (*inside)(const DecodedBlob&, Random&);
};

/// Within half the radius of a shape that is round or a box.
GridPoint near_middle(const DecodedBlob& decoded, Random& random) {
    GridPoint point;
    for (unsigned k = 0; k < 3; ++k) {
        const auto extent = static_cast<double>(decoded.extent[k]);
        point[k] = static_cast<std::int32_t>(extent * (0.5 + 0.14 * static_cast<double>(random.signed_unit())));
    }
    return point;
}

/// Near the circle in the middle of the tube, for major radius 2 and minor radius 0.7.
GridPoint in_tube(const DecodedBlob& decoded, Random& random) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(random.unit());
    const double side = 2.0 / 2.7 * 0.5 * static_cast<double>(decoded.extent[0]);
    const double off = 0.02 * static_cast<double>(decoded.extent[0]);
    const auto at = [&](unsigned k, double from_middle) {
        return static_cast<std::int32_t>(0.5 * static_cast<double>(decoded.extent[k]) + from_middle +
                                         off * static_cast<double>(random.signed_unit()));
    };
    const std::int32_t x = at(0, side * std::cos(turn));
    const std::int32_t y = at(1, side * std::sin(turn));
    const std::int32_t z = at(2, 0.0);
    return {x, y, z};
}

void add(std::vector<ClosedShape>& shapes, const Mesh& mesh, unsigned bits,
         GridPoint (*inside)(const DecodedBlob&, Random&)) {
    for (const Profile profile : every_profile) {
        OpenedBlob opened(mesh, {.resolution = Resolution::bits(bits), .profile = profile});
        DecodedBlob decoded = decode(opened.bytes);
        shapes.push_back({mesh.name + ", profile " + name_of(profile), std::move(opened), std::move(decoded), inside});
    }
}

std::vector<ClosedShape> make_closed_shapes() {
    std::vector<ClosedShape> shapes;
    add(shapes, make_far_sphere(), 16, near_middle);
    add(shapes, make_torus(48, 24, 2.0, 0.7), 16, in_tube);
    add(shapes, make_uv_sphere(30, 48, 1.0, {0.1f, 0.2f, 0.3f}), 20, near_middle);
    add(shapes, make_cube(-3.0f, 5.0f), 16, near_middle);
    return shapes;
}

/// A lattice point's place in the world where float32 holds it exactly, else false.
bool exact_place(const DecodedBlob& decoded, const GridPoint& point, Vec3& place) {
    float out[3];
    for (unsigned k = 0; k < 3; ++k) {
        const double exact = static_cast<double>(decoded.origin[k]) + std::ldexp(point[k], decoded.step_exponent);
        out[k] = static_cast<float>(exact);
        if (static_cast<double>(out[k]) != exact) return false;
    }
    place = {out[0], out[1], out[2]};
    return true;
}

/// Rounds a lattice point to one that float32 holds; on the shape's grid of floats where that is coarser than the
/// lattice.
GridPoint on_float_grid(const DecodedBlob& decoded, GridPoint point) {
    for (unsigned k = 0; k < 3; ++k) {
        const auto place =
            static_cast<float>(static_cast<double>(decoded.origin[k]) + std::ldexp(point[k], decoded.step_exponent));
        const double steps =
            std::ldexp(static_cast<double>(place) - static_cast<double>(decoded.origin[k]), -decoded.step_exponent);
        point[k] = static_cast<std::int32_t>(steps);
    }
    return point;
}

TEST_CASE("ray: no ray from inside a closed mesh leaks through a vertex or a side") {
    // Times a scale of 1,000 these are ten million rays.
    const std::uint64_t count = scaled_share(2'500);
    for (const ClosedShape& shape : make_closed_shapes()) {
        CAPTURE(shape.name);
        REQUIRE(shape.opened.blob.is_closed());
        Random random(1);
        std::uint64_t exact_aims = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const GridPoint from = on_float_grid(shape.decoded, shape.inside(shape.decoded, random));
            const GridTriangle& triangle = some_triangle(shape.decoded, random);
            const GridPoint corners[3] = {triangle.a, triangle.b, triangle.c};
            const GridPoint& p = corners[random.below(3)];
            const GridPoint& q = corners[random.below(3)];  // the same corner in a third of the rays
            Ray ray;
            const bool exact_origin = exact_place(shape.decoded, from, ray.origin);
            REQUIRE(exact_origin);
            // Twice the way to a middle is a whole number of steps: the direction is exact, and so is the aim.
            const auto toward = [&](unsigned k) {
                return std::ldexp(static_cast<float>(p[k] + q[k] - 2 * from[k]), shape.decoded.step_exponent);
            };
            ray.direction = {toward(0), toward(1), toward(2)};
            REQUIRE_MESSAGE(raycast(shape.opened.blob, ray), describe(ray));
            REQUIRE_MESSAGE(occluded(shape.opened.blob, ray).yes(), describe(ray));
            detail::LatticeRay rounded{};
            REQUIRE(detail::round_ray(detail::data_of(shape.opened.blob), ray, rounded));
            bool exact_aim = true;
            for (unsigned k = 0; k < 3; ++k) {
                exact_aim = exact_aim && rounded.origin[k] == from[k] << rounded.fraction_bits;
            }
            if (exact_aim) ++exact_aims;
            for (const InstructionPath& path : instruction_paths()) {
                REQUIRE_MESSAGE(path.closest_hit(detail::data_of(shape.opened.blob), ray, {}), std::string(path.name),
                                ": ", describe(ray));
                REQUIRE_MESSAGE(path.any_hit(detail::data_of(shape.opened.blob), ray, {}).yes(), std::string(path.name),
                                ": ", describe(ray));
            }
        }
        CHECK(exact_aims == count);
    }
}

}  // namespace
}  // namespace espalier::tests::leak_test
