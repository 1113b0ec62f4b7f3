#include "closed_shapes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "support/base/profiles.hpp"
#include "support/meshes/makers.hpp"

namespace espalier::tests {

namespace {

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
        BakeOptions options = with_profile(profile);
        options.resolution = Resolution::bits(bits);
        OpenedBlob opened(mesh, options);
        DecodedBlob decoded = decode(opened.bytes);
        shapes.push_back({mesh.name + ", profile " + name_of(profile), std::move(opened), std::move(decoded), inside});
    }
}

}  // namespace

std::vector<ClosedShape> make_closed_shapes() {
    std::vector<ClosedShape> shapes;
    add(shapes, make_far_sphere(), 16, near_middle);
    add(shapes, make_torus(48, 24, 2.0, 0.7), 16, in_tube);
    add(shapes, make_uv_sphere(30, 48, 1.0, {0.1f, 0.2f, 0.3f}), 20, near_middle);
    add(shapes, make_cube(-3.0f, 5.0f), 16, near_middle);
    return shapes;
}

}  // namespace espalier::tests
