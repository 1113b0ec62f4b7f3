// Claims about the boxes of instances: they contain the surface at its place, and little more.
#include "support/testing.hpp"

#include <baker/scenes/instance_boxes.hpp>

namespace espalier::tests::instance_boxes_test {
namespace {

/// Returns the box around all corners in the world.
baker::WorldBox box_of_corners(const Blob& blob, const Transform& transform) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    baker::WorldBox box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (std::uint32_t i = 0; i < blob.triangle_count(); ++i) {
        const Result<Triangle> triangle = triangle_at(blob, TriangleId{i});
        for (const Vec3& corner : {triangle->a, triangle->b, triangle->c}) {
            const Vec3 p = to_world(transform, corner);
            const double coordinates[3] = {double(p.x), double(p.y), double(p.z)};
            for (std::size_t k = 0; k < 3; ++k) {
                box.lo[k] = std::min(coordinates[k], box.lo[k]);
                box.hi[k] = std::max(coordinates[k], box.hi[k]);
            }
        }
    }
    return box;
}

TEST_CASE("scene: the box of a turned instance contains its corners and little more") {
    for (const Profile profile : every_profile) {
        const OpenedBlob opened(make_icosphere(5, 1.0, {3.0f, 0.0f, 0.0f}), with_profile(profile));
        const baker::PartBoxes boxes{baker::ScenePart(opened.blob)};
        Random random(7);
        for (int i = 0; i < 20; ++i) {
            Transform transform;
            transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(),
                                  random.signed_unit()};
            transform.translation = random.in_cube(100.0f);
            transform.scale = 0.5f + random.unit();
            const baker::WorldBox box = boxes.at(transform), corners = box_of_corners(opened.blob, transform);
            const double slack = 0.25 * static_cast<double>(transform.scale);  // the size of a leaf
            CAPTURE(i);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(box.lo[k] <= corners.lo[k]);
                CHECK(box.hi[k] >= corners.hi[k]);
                CHECK(box.lo[k] >= corners.lo[k] - slack);
                CHECK(box.hi[k] <= corners.hi[k] + slack);
            }
        }
    }
}

}  // namespace
}  // namespace espalier::tests::instance_boxes_test
