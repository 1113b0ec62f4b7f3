#include "poses.hpp"

#include <cmath>
#include <numbers>

#include "../../tests/support/base/random.hpp"

namespace espalier::bench {
namespace {

struct Pose {
    Quaternion rotation;
    double direction[3];
    double share;
};

/// Uniform over all rotations (Shoemake 1992) and directions.
Pose some_pose(tests::Random& random) {
    const auto unit = [&] { return static_cast<double>(random.unit()); };
    const double turn = 2.0 * std::numbers::pi;
    const double u = unit(), first = turn * unit(), second = turn * unit();
    Pose pose;
    pose.rotation = {static_cast<float>(std::sqrt(1.0 - u) * std::sin(first)),
                     static_cast<float>(std::sqrt(1.0 - u) * std::cos(first)),
                     static_cast<float>(std::sqrt(u) * std::sin(second)),
                     static_cast<float>(std::sqrt(u) * std::cos(second))};
    const double z = 2.0 * unit() - 1.0, around = turn * unit(), radius = std::sqrt(1.0 - z * z);
    pose.direction[0] = radius * std::cos(around);
    pose.direction[1] = radius * std::sin(around);
    pose.direction[2] = z;
    pose.share = 0.6 + 0.8 * unit();
    return pose;
}

/// Turned about the middle of the mesh, then moved.
Transform placed(const Pose& pose, const BoundingSphere& sphere, double length) {
    Transform placement;
    placement.rotation = pose.rotation;
    const Matrix matrix = rotation_matrix(placement);
    const double center[3] = {static_cast<double>(sphere.center.x), static_cast<double>(sphere.center.y),
                              static_cast<double>(sphere.center.z)};
    float* const to[3] = {&placement.translation.x, &placement.translation.y, &placement.translation.z};
    for (int k = 0; k < 3; ++k) {
        const auto& row = matrix.at[k];
        const double turned = row[0] * center[0] + row[1] * center[1] + row[2] * center[2];
        *to[k] = static_cast<float>(center[k] - turned + pose.direction[k] * pose.share * length);
    }
    return placement;
}

}  // namespace

Matrix rotation_matrix(const Transform& pose) {
    const double q[4] = {static_cast<double>(pose.rotation.x), static_cast<double>(pose.rotation.y),
                         static_cast<double>(pose.rotation.z), static_cast<double>(pose.rotation.w)};
    const double s = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {{{1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
             {s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)},
             {s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)}}};
}

std::vector<Transform> some_poses(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                  const std::function<bool(const Transform&)>& collides) {
    tests::Random random(seed);
    const BoundingSphere sphere = bounding_sphere(mesh);
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < count; ++i) poses.push_back(some_pose(random));
    double low = 0.0;
    double high = 2.0 * static_cast<double>(sphere.radius);
    std::vector<Transform> placements(count);
    for (int step = 0; step < 20; ++step) {
        const double length = 0.5 * (low + high);
        std::size_t colliding = 0;
        for (std::size_t i = 0; i < count; ++i) {
            placements[i] = placed(poses[i], sphere, length);
            if (collides(placements[i])) ++colliding;
        }
        if (100 * colliding > 57 * count) low = length;
        else if (100 * colliding < 53 * count) high = length;
        else break;
    }
    return placements;
}

}  // namespace espalier::bench
