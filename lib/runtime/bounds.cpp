// Bounds of the whole asset, from the blob's integers to floats that still hold everything.
#include <espalier/bounds.hpp>
#include <runtime/bytes.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/outward.hpp>
#include <runtime/stored_bounds.hpp>
#include <runtime/wide_integer.hpp>

namespace espalier {

using namespace detail;
using format::bounds::units_per_step;

namespace {

/// Lattice steps that a bound's unit is worth, times the step: in world units. Lengths below 2^29 units.
float unit_of(const BlobData& blob) { return power_of_two(blob.step_exponent - 4); }
static_assert(units_per_step == 1 << 4);

/// What rounding may have done to any coordinate of the asset, and to a sum or two of them, generously.
float rounding_of(const BlobData& blob) {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k)
        sum += absolute(blob.origin[k]) + blob.extent_steps[k] * power_of_two(blob.step_exponent);
    return sum * 0x1p-21f + 0x1p-124f;
}

/// True only if no triangle of the asset has a point within `radius` of the axis-aligned box around `center`. In
/// lattice steps; a sphere has half sides of 0, a box a radius of 0. No NaN; `center` and `half` below 2^60, none of
/// `half` or `radius` negative; an infinite radius is near everything. A blob without stored bounds answers false.
///
/// Each distance along a direction is a sum of at most eight products of exact numbers that are no larger than `size`
/// times the direction's length, so that it is wrong by less than 2^-20 of that (docs/numerics.md).
[[gnu::noinline]] bool is_beyond_bounds(const BlobData& blob, const float* center, const float* half, float radius) {
    using namespace format::bounds;
    constexpr float unit = 1.0f / units_per_step;
    constexpr float error = 0x1p-20f;
    float size = 0.0f;
    for (int k = 0; k < 3; ++k) size += absolute(center[k]) + half[k] + blob.extent_steps[k];
    const float slack = size * error;
    // Distances along three perpendicular directions make up a distance.
    const auto is_beyond = [&](const float* gap, float reach) {
        float squared = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const float certain = gap[k] - slack;
            if (certain > 0.0f) squared += certain * certain;
        }
        return squared > reach * reach * (1.0f + error);
    };
    float gap[3];
    for (int k = 0; k < 3; ++k) gap[k] = maximum(-center[k], center[k] - blob.extent_steps[k]) - half[k];
    if (is_beyond(gap, radius)) return true;
    if (const std::byte* sphere = stored_sphere(blob); sphere != nullptr) {
        for (std::size_t k = 0; k < 3; ++k) {
            const float from = static_cast<float>(load_i32(sphere + center_at + 4 * k)) * unit;
            gap[k] = absolute(center[k] - from) - half[k];
        }
        const float stored = static_cast<float>(load_u32(sphere + radius_at)) * unit;
        if (is_beyond(gap, radius + stored * (1.0f + error))) return true;
    }
    if (const std::byte* box = stored_oriented_box(blob); box != nullptr) {
        const IntegerRotation rotation = stored_rotation(box);
        const auto norm = static_cast<float>(rotation.norm);
        for (std::size_t k = 0; k < 3; ++k) {
            float at = 0.0f;
            float spread = 0.0f;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto part = static_cast<float>(rotation.row[k][axis]);
                at += part * center[axis];
                spread += absolute(part) * half[axis];
            }
            const float below = static_cast<float>(load_i32(box + lo_at + 4 * k)) * unit - at / norm;
            const float above = at / norm - static_cast<float>(load_i32(box + hi_at + 4 * k)) * unit;
            gap[k] = maximum(below, above) - spread / norm;
        }
        if (is_beyond(gap, radius)) return true;
    }
    if (const std::byte* k_dop = stored_k_dop(blob); k_dop != nullptr) {
        for (std::size_t k = 0; k < k_dop_directions; ++k) {
            const auto& d = k_dop_direction[k];
            float at = 0.0f;
            float spread = slack + slack;
            int axes = 0;
            for (int axis = 0; axis < 3; ++axis) {
                if (d[axis] == 0) continue;
                at += d[axis] > 0 ? center[axis] : -center[axis];
                spread += half[axis];
                ++axes;
            }
            const float length = axes == 2 ? 1.4142137f : 1.7320509f;  // rounded up
            spread += radius * length * (1.0f + error);
            const auto lo = static_cast<float>(load_i32(k_dop + 8 * k));
            const auto hi = static_cast<float>(load_i32(k_dop + 8 * k + 4));
            if (at + spread < lo || at - spread > hi) return true;
        }
    }
    return false;
}

}  // namespace

bool bounding_sphere(const Blob& blob, Sphere& sphere) noexcept {
    const BlobData& data = blob.data();
    const std::byte* stored = stored_sphere(data);
    if (stored == nullptr) return false;
    const float unit = unit_of(data);
    float center[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const auto steps = static_cast<float>(load_i32(stored + format::bounds::center_at + 4 * k));
        center[k] = flush_subnormal(data.origin[k] + flush_subnormal(steps * unit));
    }
    const auto radius = static_cast<float>(load_u32(stored + format::bounds::radius_at));
    sphere = {{center[0], center[1], center[2]}, (radius * unit + rounding_of(data)) * (1.0f + 0x1p-20f)};
    return true;
}

bool oriented_bounds(const Blob& blob, OrientedBox& box) noexcept {
    const BlobData& data = blob.data();
    const std::byte* stored = stored_oriented_box(data);
    if (stored == nullptr) return false;
    const IntegerRotation rotation = stored_rotation(stored);
    const auto norm = static_cast<float>(rotation.norm);
    const float unit = unit_of(data);
    std::int64_t twice_center[3] = {0, 0, 0};  // times the norm; below 2^57
    float half[3];
    float sum = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t lo = load_i32(stored + format::bounds::lo_at + 4 * k);
        const std::int64_t hi = load_i32(stored + format::bounds::hi_at + 4 * k);
        for (std::size_t axis = 0; axis < 3; ++axis) twice_center[axis] += (lo + hi) * rotation.row[k][axis];
        half[k] = to_float(hi - lo) * 0.5f * unit;
        sum += half[k];
    }
    float center[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float length = flush_subnormal(to_float(twice_center[axis]) / norm * 0.5f * unit);
        center[axis] = flush_subnormal(data.origin[axis] + length);
    }
    box.center = {center[0], center[1], center[2]};
    const float more = rounding_of(data) + sum * 0x1p-20f;  // also for axes that rounding turned a little
    for (std::size_t k = 0; k < 3; ++k) {
        const float length = half[k] + more;
        const auto part = [&](std::size_t axis) {
            if (rotation.row[k][axis] == 0) return 0.0f;  // also where a length is infinite
            return flush_subnormal(static_cast<float>(rotation.row[k][axis]) / norm * length);
        };
        box.half_axes[k] = {part(0), part(1), part(2)};
    }
    return true;
}

bool k_dop_bounds(const Blob& blob, KDop& k_dop) noexcept {
    const BlobData& data = blob.data();
    const std::byte* stored = stored_k_dop(data);
    if (stored == nullptr) return false;
    const float step = power_of_two(data.step_exponent);
    const float rounding = rounding_of(data);
    constexpr unsigned axes = 3;
    static_assert(axes + format::bounds::k_dop_directions == KDop::count);
    for (unsigned k = 0; k < KDop::count; ++k) {
        const Vec3& d = KDop::directions[k];
        const float origin = d.x * data.origin[0] + d.y * data.origin[1] + d.z * data.origin[2];
        const std::byte* slab = stored + 8 * std::size_t{k < axes ? 0 : k - axes};
        const float lo = k < axes ? 0.0f : static_cast<float>(load_i32(slab));
        const float hi = k < axes ? data.extent_steps[k] : static_cast<float>(load_i32(slab + 4));
        k_dop.lo[k] = flush_subnormal(origin + (lo * step - rounding));
        k_dop.hi[k] = flush_subnormal(origin + (hi * step + rounding));
    }
    return true;
}

bool is_outside_bounds(const Blob& blob, const Sphere& sphere) noexcept {
    const BlobData& data = blob.data();
    LatticePoint point;
    if (data.triangle_count == 0 || !round_point(data, sphere.center, sphere.radius, point)) return true;
    constexpr float no_sides[3] = {0.0f, 0.0f, 0.0f};
    return is_beyond_bounds(data, point.steps, no_sides, point.radius);
}

bool is_outside_bounds(const Blob& blob, const Box& box) noexcept {
    const BlobData& data = blob.data();
    const float low_world[3] = {box.min.x, box.min.y, box.min.z};
    const float high_world[3] = {box.max.x, box.max.y, box.max.z};
    float center[3];
    float half[3];
    if (data.triangle_count == 0 || is_nan(box.min) || is_nan(box.max) || is_empty(box)) return true;
    for (int k = 0; k < 3; ++k) {
        // Cut off well outside of the asset: what is left touches it as before.
        const float reach = data.extent_steps[k] + 1.0f;
        const auto cut = [&](float world) { return minimum(maximum(to_steps(data, k, world), -reach), reach + reach); };
        const float low = cut(low_world[k]);
        const float high = cut(high_world[k]);
        center[k] = 0.5f * (low + high);
        half[k] = 0.5f * (high - low);
    }
    return is_beyond_bounds(data, center, half, 0.0f);
}

}  // namespace espalier
