// Bounds of the whole asset, from the blob's integers to floats that still hold everything.
#include <espalier/bounds.hpp>
#include <runtime/asset/lookups.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/wide_integer.hpp>
#include <runtime/blob/stored_bounds.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Lattice steps that a bound's unit is worth, times the step: in local units. Lengths below 2^29 units.
float unit_of(const BlobData& blob) { return power_of_two(blob.step_exponent - 4); }
static_assert(format::bounds::units_per_step == 1 << 4);

/// What rounding may have done to any coordinate of the asset, and to a sum or two of them, generously.
float rounding_of(const BlobData& blob) {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k)
        sum += absolute(blob.origin[k]) + blob.extent_steps[k] * power_of_two(blob.step_exponent);
    return sum * 0x1p-21f + 0x1p-124f;
}

}  // namespace

Result<Sphere> bounding_sphere(const Blob& blob) noexcept {
    const BlobData& data = data_of(blob);
    const std::byte* stored = stored_bounds(data, format::feature::bounding_sphere);
    if (stored == nullptr) return {{}, status_of_section(data, stored)};
    const float unit = unit_of(data);
    float center[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const auto steps = static_cast<float>(load_i32(stored + format::bounds::center_at + 4 * k));
        center[k] = flush_subnormal(data.origin[k] + flush_subnormal(steps * unit));
    }
    const auto radius = static_cast<float>(load_u32(stored + format::bounds::radius_at));
    return {{{center[0], center[1], center[2]}, (radius * unit + rounding_of(data)) * (1.0f + 0x1p-20f)},
            QueryStatus::ok};
}

Result<OrientedBox> oriented_bounds(const Blob& blob) noexcept {
    const BlobData& data = data_of(blob);
    const std::byte* stored = stored_bounds(data, format::feature::oriented_box);
    Result<OrientedBox> box = {{}, status_of_section(data, stored)};
    if (!box) return box;
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
    box.value.center = {center[0], center[1], center[2]};
    const float more = rounding_of(data) + sum * 0x1p-20f;  // also for axes that rounding turned a little
    for (std::size_t k = 0; k < 3; ++k) {
        const float length = half[k] + more;
        const auto part = [&](std::size_t axis) {
            if (rotation.row[k][axis] == 0) return 0.0f;  // also where a length is infinite
            return flush_subnormal(static_cast<float>(rotation.row[k][axis]) / norm * length);
        };
        box.value.half_axes[k] = {part(0), part(1), part(2)};
    }
    return box;
}

Result<KDop> k_dop_bounds(const Blob& blob) noexcept {
    const BlobData& data = data_of(blob);
    const std::byte* stored = stored_bounds(data, format::feature::k_dop);
    Result<KDop> k_dop = {{}, status_of_section(data, stored)};
    if (!k_dop) return k_dop;
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
        k_dop.value.lo[k] = flush_subnormal(origin + (lo * step - rounding));
        k_dop.value.hi[k] = flush_subnormal(origin + (hi * step + rounding));
    }
    return k_dop;
}

}  // namespace espalier
