// Poses of a deformable blob, the same on every machine: each coordinate comes from those at rest by operations that
// round alike everywhere. No heap, no libc, no doubles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/deformation.hpp>
#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/deformable_blob.hpp>
#include <runtime/lattice/to_local.hpp>

namespace espalier::platform {

/// Writes the positions that a blob has in its pose. Those without a triangle are not written.
inline void read_positions(const Blob& blob, std::span<Vec3> positions) {
    const detail::BlobData& data = detail::data_of(blob);
    const std::byte* source = detail::vertex_sources_of(data);
    const bool is_short = positions.size() <= 0x10000;
    for (std::uint32_t number = 0; number < data.node_count; ++number) {
        const auto node = detail::node_at<detail::PlainNode>(data, number);
        for (unsigned child = 0; child < node.leaf_children(); ++child) {
            const auto leaf = detail::leaf_at<detail::PlainLeaf>(data, node, child);
            for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
                const std::int32_t point[3] = {leaf.offset(0, vertex), leaf.offset(1, vertex), leaf.offset(2, vertex)};
                positions[is_short ? detail::load_u16(source) : detail::load_u32(source)] =
                    detail::to_local(data, point);
                source += is_short ? 2 : 4;
            }
        }
    }
}

/// Poses made from the positions at rest.
class Poses {
public:
    static constexpr std::uint32_t count = 8;

    /// `rest` has the positions of a blob, and is read for each pose.
    Poses(const Deformable& mesh, std::span<const Vec3> rest) : rest_(rest), range_(mesh.range()) {
        const Box box = mesh.blob().bounds();
        low_ = box.min;
        size_ = {box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z};
        largest_side_ = larger(size_.x, larger(size_.y, size_.z));
    }

    /// Writes a pose; those from `count` on are the same again.
    void make(std::uint32_t number, std::span<Vec3> pose) const {
        for (std::size_t i = 0; i < pose.size(); ++i)
            pose[i] = in_range(moved(number % count, rest_[i], static_cast<std::uint32_t>(i)));
    }

private:
    static float larger(float a, float b) { return a > b ? a : b; }
    static float smaller(float a, float b) { return a < b ? a : b; }
    static float between(float value, float low, float high) { return smaller(larger(value, low), high); }
    [[nodiscard]] Vec3 in_range(const Vec3& position) const {
        return {between(position.x, range_.min.x, range_.max.x), between(position.y, range_.min.y, range_.max.y),
                between(position.z, range_.min.z, range_.max.z)};
    }
    /// Returns a number from -1 to 1 that a position's number and an axis choose.
    static float noise(std::uint32_t number) {
        std::uint32_t word = (number ^ number >> 16) * 0x7FEB352Du;
        word = (word ^ word >> 15) * 0x846CA68Bu;
        return static_cast<float>(static_cast<std::int32_t>((word ^ word >> 16) >> 8) - 0x800000) * 0x1p-23f;
    }

    [[nodiscard]] Vec3 moved(std::uint32_t number, const Vec3& at, std::uint32_t index) const {
        const float along = size_.x > 0.0f ? (at.x - low_.x) / size_.x : 0.0f;  // 0 to 1
        const float from_middle = along - 0.5f;
        Vec3 to = at;
        if (number == 1) {  // a wave of straight lines
            const float phase = along * 4.0f;
            const float part = phase - static_cast<float>(static_cast<std::int32_t>(phase));
            to.z += (part < 0.5f ? part : 1.0f - part) * largest_side_ * 0.125f;
        }
        if (number == 2) to.z += from_middle * from_middle * largest_side_ * 0.25f;  // bent to a parabola
        if (number == 3) {
            to.x += noise(3 * index) * largest_side_ * 0.03125f;
            to.y += noise(3 * index + 1) * largest_side_ * 0.03125f;
            to.z += noise(3 * index + 2) * largest_side_ * 0.03125f;
        }
        if (number == 4 && from_middle > 0.0f) to.x = low_.x + (1.0f - along) * size_.x;  // folded onto one half
        if (number == 5) to.y = low_.y + size_.y * 0.5f;                                  // flat
        if (number == 6) to = {(low_.x + at.x) * 0.5f, (low_.y + at.y) * 0.5f, (low_.z + at.z) * 0.5f};  // smaller
        if (number == 7) to = {at.x, low_.y, low_.z};                                                    // a segment
        return to;
    }

    std::span<const Vec3> rest_;
    Box range_;
    Vec3 low_, size_;
    float largest_side_;
};

}  // namespace espalier::platform
