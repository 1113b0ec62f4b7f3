#include "refit/pose_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "support/base/hostile_values.hpp"

namespace espalier::fuzz {

using namespace tests;

namespace {

using Coordinate = float Vec3::*;
constexpr std::array<Coordinate, 3> axes = {&Vec3::x, &Vec3::y, &Vec3::z};

}  // namespace

PoseMaker::PoseMaker(const DecodedBlob& blob, const PoseModel& model, std::vector<Vec3> first_pose)
    : blob_(blob), model_(model), first_(std::move(first_pose)), last_(first_) {
    for (const auto& corners : blob.corner_sources) used_.insert(used_.end(), corners.begin(), corners.end());
    std::ranges::sort(used_);
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
}

Vec3 PoseMaker::anywhere(Random& random) const {
    GridPoint point{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = random.between(0, static_cast<std::int32_t>(blob_.extent[axis]));
    return model_.position_at(point);
}

Vec3 PoseMaker::at_an_end(Random& random) const {
    Vec3 position = anywhere(random);
    const std::size_t axis = random.below(3);
    constexpr double beyond[] = {0.0, 0.25, 0.5, 0.75, 1.0, -0.5, 1e6};
    const double steps = beyond[random.below(static_cast<std::uint32_t>(std::size(beyond)))];
    const double coordinate = random.coin() ? -steps : double(blob_.extent[axis]) + steps;
    position.*axes[axis] = static_cast<float>(double(blob_.origin[axis]) + std::ldexp(coordinate, blob_.step_exponent));
    return position;
}

Vec3 PoseMaker::on_small_grid(Random& random) const {
    GridPoint point{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto end = static_cast<std::int32_t>(blob_.extent[axis]);
        point[axis] = std::min(end, random.between(0, 3) * std::max(1, end / 3));
    }
    return model_.position_at(point);
}

/// Onto a plane, a line or a point.
void PoseMaker::flatten(std::vector<Vec3>& pose, Random& random) const {
    const Vec3 place = anywhere(random);
    const std::uint32_t flat_axes = 1 + random.below(7);
    for (const std::uint32_t number : used_)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if ((flat_axes >> axis & 1u) != 0) pose[number].*axes[axis] = place.*axes[axis];
}

void PoseMaker::wave(std::vector<Vec3>& pose, Random& random) const {
    const std::size_t along = random.below(3), across = random.below(3);
    const double length = std::ldexp(1.0 + double(blob_.extent[along]), blob_.step_exponent - random.between(0, 4));
    const double height = std::ldexp(double(blob_.extent[across]), blob_.step_exponent - random.between(1, 6));
    for (const std::uint32_t number : used_) {
        Vec3& position = pose[number];
        const double from_origin = double(position.*axes[along]) - double(blob_.origin[along]);
        const double moved = double(position.*axes[across]) + height * std::sin(6.28 * from_origin / length);
        const double low = double(blob_.origin[across]);
        const double high = low + std::ldexp(double(blob_.extent[across]), blob_.step_exponent);
        position.*axes[across] = static_cast<float>(std::clamp(moved, low, high));
    }
}

std::uint32_t& PoseMaker::any_used(Random& random) {
    return used_[random.below(static_cast<std::uint32_t>(used_.size()))];
}

std::vector<Vec3> PoseMaker::next(Random& random) {
    std::vector<Vec3> pose = last_;
    switch (random.below(12)) {
        case 0:
        case 1:
            for (const std::uint32_t number : used_) pose[number] = anywhere(random);
            break;
        case 2:
        case 3:
            for (std::uint32_t i = 0; i <= random.below(4); ++i) pose[any_used(random)] = anywhere(random);
            break;
        case 4:
            flatten(pose, random);
            break;
        case 5:
        case 6:
            wave(pose, random);
            break;
        case 7:
            for (const std::uint32_t number : used_) pose[number] = on_small_grid(random);
            break;
        case 8:
            for (std::uint32_t i = 0; i <= random.below(3); ++i) pose[any_used(random)] = at_an_end(random);
            break;
        case 9: {
            // Also a position without a triangle.
            const std::uint32_t number =
                random.coin() ? any_used(random) : random.below(static_cast<std::uint32_t>(pose.size()));
            pose[number].*axes[random.below(3)] =
                hostile_values[random.below(static_cast<std::uint32_t>(hostile_values.size()))];
            break;
        }
        case 10:
            if (random.coin()) pose.resize(random.below(static_cast<std::uint32_t>(pose.size())));
            else pose.resize(pose.size() + 1 + random.below(3), pose[0]);
            break;
        default:
            pose = first_;
    }
    return pose;
}

}  // namespace espalier::fuzz
