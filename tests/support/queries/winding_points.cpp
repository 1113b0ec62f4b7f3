#include "winding_points.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "support/base/profiles.hpp"
#include "support/meshes/makers.hpp"
#include "surface.hpp"

namespace espalier::tests {

const std::vector<TestBlob>& closed_blobs() {
    static const std::vector<TestBlob> blobs = [] {
        std::vector<TestBlob> made;
        const auto add = [&](const Mesh& mesh, unsigned bits) {
            for (const Profile profile : every_profile) {
                OpenedBlob opened(mesh, {.resolution = Resolution::bits(bits), .profile = profile});
                if (!opened.blob.is_closed()) throw std::runtime_error(mesh.name + " is not closed");
                DecodedBlob decoded = decode(opened.bytes);
                made.push_back({mesh.name + ", profile " + name_of(profile), std::move(opened), std::move(decoded)});
            }
        };
        const auto sphere = [](double radius, Vec3 center) { return make_icosphere(1, radius, center); };
        add(make_cube(-1.0f, 1.0f), 16);
        add(make_cube(0.0f, 1.0f), 1);
        add(make_torus(16, 8, 2.0, 0.7), 5);
        add(make_torus(24, 12, 2.0, 0.7), 24);
        add(make_uv_sphere(8, 12, 1.0, {0.0f, 0.0f, 0.0f}), 12);
        add(make_icosphere(2, 2.0, {148376.0f, 1234.0f, -223423.0f}), 16);
        add(turned_inside_out(sphere(1.0, {0.0f, 0.0f, 0.0f})), 10);
        add(joined(make_cube(-2.0f, 2.0f), turned_inside_out(make_cube(-1.0f, 1.0f))), 8);
        add(joined(joined(make_cube(-4.0f, 4.0f), turned_inside_out(sphere(3.0, {0.0f, 0.0f, 0.0f}))),
                   sphere(1.5, {0.5f, 0.25f, 0.0f})),
            16);
        add(joined(sphere(1.0, {0.0f, 0.0f, 0.0f}), sphere(1.0, {0.75f, 0.5f, 0.0f})), 16);
        add(joined(make_cube(0.0f, 2.0f), turned_inside_out(make_cube(1.0f, 3.0f))), 4);
        return made;
    }();
    return blobs;
}

Vec3 awkward_point(const TestBlob& blob, Random& random) {
    const GridTriangle& t = some_triangle(blob.decoded, random);
    const std::uint32_t kind = random.below(5);
    double at[3];
    for (unsigned k = 0; k < 3; ++k) {
        if (kind == 0) at[k] = t.a[k];
        else if (kind == 1) at[k] = 0.5 * (t.a[k] + t.b[k]);
        else if (kind == 2) at[k] = 0.25 * t.a[k] + 0.25 * t.b[k] + 0.5 * t.c[k];
        else at[k] = some_corner(blob.decoded, random)[k];
    }
    if (kind < 3 && random.below(4) != 0) {
        const std::uint32_t axis = random.below(3);
        at[axis] = random.coin() ? some_corner(blob.decoded, random)[axis]
                                 : static_cast<double>(random.unit()) * blob.decoded.extent[axis];
    }
    return place_in_world(blob.decoded, at[0], at[1], at[2]);
}

Vec3 random_point(const TestBlob& blob, Random& random) {
    const Vec3 low = blob.opened.blob.bounds().min;
    const Vec3 high = blob.opened.blob.bounds().max;
    const auto between = [&](float from, float to) { return from + (to - from) * (random.unit() * 1.1f - 0.05f); };
    const float x = between(low.x, high.x);
    const float y = between(low.y, high.y);
    return {x, y, between(low.z, high.z)};
}

std::optional<detail::WindingRay> shortest_way_out(const Blob& blob, Vec3 point) {
    detail::RoundedPoint rounded;
    detail::WindingRay ray;
    if (detail::round_point(detail::data_of(blob), point, std::numeric_limits<float>::infinity(), rounded) !=
        QueryStatus::ok)
        return std::nullopt;
    if (!detail::shortest_way_out(detail::data_of(blob), rounded, ray)) return std::nullopt;
    return ray;
}

}  // namespace espalier::tests
