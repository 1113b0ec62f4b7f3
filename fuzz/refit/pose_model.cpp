#include "refit/pose_model.hpp"

#include <algorithm>
#include <cmath>

#include "judge.hpp"
#include "support/blobs/soundness.hpp"

namespace espalier::fuzz {

using namespace tests;

Vec3 PoseModel::position_at(const GridPoint& point) const {
    const auto along = [&](std::size_t axis) {
        return static_cast<float>(double(blob_.origin[axis]) + std::ldexp(double(point[axis]), blob_.step_exponent));
    };
    return {along(0), along(1), along(2)};
}

std::optional<std::int32_t> PoseModel::coordinate(float position, std::size_t axis) const {
    const double steps = std::nearbyint(std::ldexp(double(position), -blob_.step_exponent)) -
                         std::ldexp(double(blob_.origin[axis]), -blob_.step_exponent);
    if (!(steps >= 0.0 && steps <= double(blob_.extent[axis]))) return std::nullopt;
    return static_cast<std::int32_t>(steps);
}

std::optional<GridPoint> PoseModel::point_at(const Vec3& position) const {
    const auto x = coordinate(position.x, 0), y = coordinate(position.y, 1), z = coordinate(position.z, 2);
    if (!x || !y || !z) return std::nullopt;
    return GridPoint{*x, *y, *z};
}

std::optional<std::vector<Vec3>> PoseModel::positions_of_pose() const {
    std::vector<Vec3> positions(blob_.position_count, position_at({0, 0, 0}));
    std::vector<std::optional<GridPoint>> points(blob_.position_count);
    for (std::size_t i = 0; i < blob_.triangles.size(); ++i) {
        const GridTriangle& triangle = blob_.triangles[i];
        const GridPoint corners[] = {triangle.a, triangle.b, triangle.c};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t number = blob_.corner_sources[i][corner];
            if (points[number] && points[number] != corners[corner]) return std::nullopt;
            points[number] = corners[corner];
            positions[number] = position_at(corners[corner]);
            if (point_at(positions[number]) != corners[corner]) return std::nullopt;
        }
    }
    return positions;
}

RefitResult PoseModel::result_of(std::span<const Vec3> positions) const {
    const auto number = [](std::size_t index) { return static_cast<std::uint32_t>(index); };
    if (positions.size() != blob_.position_count)
        return {QueryStatus::invalid_argument, std::min(number(positions.size()), blob_.position_count), 0.0f};
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto& [x, y, z] = positions[i];
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
            return {QueryStatus::invalid_argument, number(i), 0.0f};
        if (!point_at(positions[i])) return {QueryStatus::out_of_range, number(i), 0.0f};
    }
    return {QueryStatus::ok, 0, 0.0f};
}

void PoseModel::check(const DecodedBlob& sealed, std::span<const Vec3> positions) const {
    require(sealed.corner_sources == blob_.corner_sources, "the sources of vertices have changed");
    for (std::size_t i = 0; i < sealed.triangles.size(); ++i) {
        const auto corner = [&](std::size_t k) { return *point_at(positions[sealed.corner_sources[i][k]]); };
        require(sealed.triangles[i] == GridTriangle{corner(0), corner(1), corner(2)},
                "a triangle is not at its positions");
    }
    require(is_sound(sealed), "a box does not hold what is below it, or ends too far away");
}

}  // namespace espalier::fuzz
