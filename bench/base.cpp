#include <ctime>
#include <fstream>
#include <numbers>

#include "base.hpp"

namespace espalier::bench {
namespace {

Aabb box_of(const Mesh& mesh) {
    Aabb box = Aabb::none();
    for (const TriangleVertices& t : mesh.triangles)
        for (const std::uint32_t v : t) box.add(mesh.positions[v]);
    return box;
}

float center(const Aabb& box, std::size_t k) { return 0.5f * (box.low[k] + box.high[k]); }

float radius_of(const Aabb& box) {
    const auto squared = [&](std::size_t k) { return (box.high[k] - box.low[k]) * (box.high[k] - box.low[k]); };
    return 0.5f * std::sqrt(squared(0) + squared(1) + squared(2));
}

float coordinate(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Ray towards(const float* from, const float* to) {
    float d[3];
    float squared = 0.0f;
    for (int k = 0; k < 3; ++k) {
        d[k] = to[k] - from[k];
        squared += d[k] * d[k];
    }
    const float scale = 1.0f / std::sqrt(squared);
    Ray ray;
    ray.origin = {from[0], from[1], from[2]};
    ray.direction = {d[0] * scale, d[1] * scale, d[2] * scale};
    return ray;
}

}  // namespace

Aabb Aabb::none() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

void Aabb::add(const Vec3& point) {
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], coordinate(point, k));
        high[k] = std::max(high[k], coordinate(point, k));
    }
}

void Aabb::add(const Aabb& box) {
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], box.low[k]);
        high[k] = std::max(high[k], box.high[k]);
    }
}

bool Aabb::contains(const Vec3& point, float rounding) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (coordinate(point, k) < low[k] - rounding || coordinate(point, k) > high[k] + rounding) return false;
    return true;
}

double Aabb::half_area() const {
    std::array<double, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (high[k] < low[k]) return 0.0;
        side[k] = static_cast<double>(high[k]) - static_cast<double>(low[k]);
    }
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

BoundingSphere bounding_sphere(const Mesh& mesh) {
    const Aabb box = box_of(mesh);
    return {{center(box, 0), center(box, 1), center(box, 2)}, radius_of(box)};
}

Box box_around(std::span<const Vec3> positions) {
    Box box = {positions.front(), positions.front()};
    for (const Vec3& p : positions) {
        box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
        box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
    return box;
}

double bring_to_common_size(Mesh& mesh) {
    const Aabb box = box_of(mesh);
    float extent = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, box.high[k] - box.low[k]);
    if (!(extent > 0.0f) || std::isinf(extent)) return 1.0;
    const int exponent = 7 - std::ilogb(extent);
    for (Vec3& p : mesh.positions)
        p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    return std::ldexp(1.0, exponent);
}

std::vector<Ray> coherent_rays(const Mesh& mesh) {
    const Aabb box = box_of(mesh);
    const float radius = radius_of(box);
    std::vector<Ray> rays;
    for (std::size_t view = 0; view < 3; ++view) {
        const std::size_t forward = 2 - view, right = (forward + 1) % 3, up = (forward + 2) % 3;
        float eye[3] = {center(box, 0), center(box, 1), center(box, 2)};
        eye[forward] += 2.4f * radius;
        for (int row = 0; row < 512; ++row)
            for (int column = 0; column < 512; ++column) {
                float target[3] = {center(box, 0), center(box, 1), center(box, 2)};
                target[right] += radius * (static_cast<float>(column) - 255.5f) / 256.0f;
                target[up] += radius * (static_cast<float>(row) - 255.5f) / 256.0f;
                rays.push_back(towards(eye, target));
            }
    }
    return rays;
}

std::vector<Ray> incoherent_rays(const Mesh& mesh, std::size_t count, std::uint64_t number) {
    const Aabb box = box_of(mesh);
    const float radius = 1.2f * radius_of(box);
    tests::Random random(number);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const float s[3] = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
        const float squared = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        if (squared > 1.0f || squared < 1e-3f) continue;
        float from[3], to[3];
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = center(box, k) + s[k] * (radius / std::sqrt(squared));
            to[k] = box.low[k] + random.unit() * (box.high[k] - box.low[k]);
        }
        rays.push_back(towards(from, to));
    }
    return rays;
}

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

std::vector<Transform> some_poses(const Mesh& mesh, std::size_t count, std::uint64_t number,
                                  const std::function<bool(const Transform&)>& collides) {
    tests::Random random(number);
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

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            if (const std::size_t colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
    return "";
}

const char* compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "gcc " __VERSION__;
#endif
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[16] = "";
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

}  // namespace espalier::bench
