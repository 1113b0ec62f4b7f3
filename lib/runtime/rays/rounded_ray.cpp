// Rays rounded once for several blobs on one lattice, and moved onto each by whole steps.
#include <espalier/advanced/rounding.hpp>
#include <espalier/transform.hpp>

#include <bit>

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/lattice/region.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/rays/queries.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns the parts of a blob that rounding reads, as if the blob filled the region.
BlobData asset_of(const Lattice& region) {
    BlobData asset;
    asset.step_exponent = static_cast<std::int16_t>(region.step_exponent);
    asset.bits = format::max_bits;
    asset.origin[0] = region.origin.x;
    asset.origin[1] = region.origin.y;
    asset.origin[2] = region.origin.z;
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (int k = 0; k < 3; ++k) asset.extent[k] = region.extent[k];
    asset.derive();
    return asset;
}

/// Tests what the kernels rely on (docs/numerics.md, 2). round_ray leaves nothing else, but the words of a handle in C
/// may be any.
bool is_ray_of_region(const RoundedRayData& ray) {
    constexpr std::int32_t most_units = 1 << 24;
    constexpr std::int32_t most_t_exponent = format::max_step_exponent + 172;  // a subnormal direction's shift
    if (ray.fraction_bits < 0 || ray.fraction_bits > 6 || ray.longest_axis > 2) return false;
    for (int k = 0; k < 3; ++k) {
        const std::int32_t origin = ray.origin[k], extent = ray.region.extent[k];
        if (origin < -most_units || origin > most_units || extent < 0 || extent > most_steps) return false;
        if (origin - (extent << ray.fraction_bits) < -most_units) return false;
    }
    const auto is_within = [](std::int32_t number, std::int32_t most) { return number >= -most && number <= most; };
    const std::int32_t along = ray.direction[ray.longest_axis];
    if (!is_within(along, most_units - 1) || is_within(along, most_units / 2 - 1)) return false;
    // mutant(< -> <=) equivalent: 0 is refused above
    const std::int32_t longest = along < 0 ? -along : along;
    for (const std::int32_t way : ray.direction)
        if (!is_within(way, longest)) return false;
    // By their bits. As to_tau leaves them: 0, also -0, or from 2^-100 on.
    const auto is_tau = [](float tau, std::uint32_t most) {
        const auto bits = std::bit_cast<std::uint32_t>(tau);
        return magnitude_bits(tau) == 0 || (bits >= magnitude_bits(0x1p-100f) && bits <= most);
    };
    return is_within(ray.t_exponent, most_t_exponent) && is_tau(ray.tau_min, infinity_bits - 1) &&
           is_tau(ray.tau_max, infinity_bits) && is_tau(ray.tau_offset, magnitude_bits(0x1p121f)) &&
           !is_nan(ray.t_min) && !is_nan(ray.t_max);
}

/// Moves the ray so that it counts from lattice point 0 0 0 of the blob. Writes it only if it may hit the region.
QueryStatus move_to(const BlobData& blob, const RoundedRayData& ray, RayOnLattice& moved) {
    std::int32_t steps[3] = {};
    if (const QueryStatus status = find_in_region(blob, ray.region, steps); status != QueryStatus::ok) return status;
    // mutant(never) sanitizer: shifts by words of a handle that nothing has tested
    if (ray.may_hit == 0) return QueryStatus::ok;
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (int k = 0; k < 3; ++k) {
        moved.ray.origin[k] = ray.origin[k] - (steps[k] << ray.fraction_bits);
        moved.ray.direction[k] = ray.direction[k];
    }
    moved.ray.fraction_bits = ray.fraction_bits;
    moved.ray.t_exponent = ray.t_exponent;
    moved.ray.tau_min = ray.tau_min;
    moved.ray.tau_max = ray.tau_max;
    moved.ray.tau_offset = ray.tau_offset;
    set_longest_axis(moved.ray, ray.longest_axis);
    moved.ray.culling = ray.culling;
    moved.t_min = ray.t_min;
    moved.t_max = ray.t_max;
    return QueryStatus::ok;
}

/// Tests the arguments of a query and moves the ray onto the blob. Returns ok if the blob must be walked, else the
/// query's status.
QueryStatus begin(const Blob& blob, const RoundedRayData& ray, RayOnLattice& moved) {
    const QueryStatus nothing = nothing_in(data_of(blob));
    QueryStatus status = nothing == QueryStatus::not_open ? nothing : refusal_of(ray);
    if (status == QueryStatus::ok && blob.triangle_count() != 0) status = move_to(data_of(blob), ray, moved);
    return status == QueryStatus::ok && (blob.triangle_count() == 0 || ray.may_hit == 0) ? nothing : status;
}

}  // namespace

QueryStatus detail::refusal_of(const RoundedRayData& ray) {
    if (ray.status == QueryStatus::out_of_range) return ray.status;
    const bool is_sound = ray.status == QueryStatus::ok && (ray.may_hit == 0 || is_ray_of_region(ray));
    return is_sound ? QueryStatus::ok : QueryStatus::invalid_argument;
}

Result<Lattice> lattice_of(std::span<const Blob> blobs) noexcept {
    Result<Lattice> region;
    Lattice& found = region.value;
    bool is_first = true;
    for (const Blob& blob : blobs) {
        if (nothing_in(data_of(blob)) == QueryStatus::not_open) return {{}, QueryStatus::not_open};
        if (blob.triangle_count() == 0) continue;
        const Lattice lattice = blob.lattice();
        if (is_first) found = lattice;
        is_first = false;
        if (lattice.step_exponent != found.step_exponent) return {{}, QueryStatus::invalid_argument};
        found.origin.x = minimum(found.origin.x, lattice.origin.x);
        found.origin.y = minimum(found.origin.y, lattice.origin.y);
        found.origin.z = minimum(found.origin.z, lattice.origin.z);
    }
    for (std::int32_t& extent : found.extent) extent = 0;
    for (const Blob& blob : blobs) {
        if (blob.triangle_count() == 0) continue;
        const BlobData& data = data_of(blob);
        const float from[3] = {found.origin.x, found.origin.y, found.origin.z};
        for (int k = 0; k < 3; ++k) {
            std::int32_t steps = 0;
            if (!whole_steps(from[k], data.origin[k], data.steps_per_unit, steps) ||
                steps + data.extent[k] > most_steps)
                return {{}, QueryStatus::out_of_range};
            // mutant(> -> >=) equivalent: both sides are equal then
            if (steps + data.extent[k] > found.extent[k]) found.extent[k] = steps + data.extent[k];
        }
    }
    region.status = QueryStatus::ok;
    return region;
}

RoundedRay round_ray(const Lattice& region, const Ray& ray) noexcept {
    RoundedRay result;
    RoundedRayData& data = result.data_;
    if (!is_region(region)) return result;
    const BlobData asset = asset_of(region);
    const QueryStatus status = refusal_or_miss(asset, ray);
    data.status = is_refused(status) ? status : QueryStatus::ok;
    // mutant(never) equivalent: queries return the status of a refused ray and read nothing else of it
    if (data.status != QueryStatus::ok) return result;
    data.region = region;
    data.t_min = ray.t_min;
    data.t_max = ray.t_max;
    data.culling = ray.culling;
    IntegerRay rounded{};
    float reach = 0.0f;
    data.may_hit = detail::round_ray(asset, ray, rounded, reach) ? 1 : 0;
    // mutant(never) equivalent: queries read no more of a ray that hits nothing
    if (data.may_hit == 0) return result;
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (int k = 0; k < 3; ++k) {
        data.origin[k] = rounded.origin[k];
        data.direction[k] = rounded.direction[k];
    }
    data.fraction_bits = rounded.fraction_bits;
    data.t_exponent = rounded.t_exponent;
    data.tau_min = rounded.tau_min;
    data.tau_max = rounded.tau_max;
    data.tau_offset = rounded.tau_offset;
    data.longest_axis = rounded.axis[2];
    return result;
}

RayHit raycast(const Blob& blob, const RoundedRay& ray, const TriangleFilter& filter) noexcept {
    RayOnLattice moved;
    const QueryStatus status = begin(blob, ray.data(), moved);
    if (status != QueryStatus::ok) return miss_with(status);
    return ESPALIER_DISPATCH_RAY(closest_hit_on_lattice, data_of(blob), moved, filter);
}

YesNo occluded(const Blob& blob, const RoundedRay& ray, const TriangleFilter& filter) noexcept {
    RayOnLattice moved;
    const QueryStatus status = begin(blob, ray.data(), moved);
    if (status != QueryStatus::ok) return YesNo(status);
    return ESPALIER_DISPATCH_RAY(any_hit_on_lattice, data_of(blob), moved, filter);
}

QueryStatus for_each_hit(const Blob& blob, const RoundedRay& ray, Visitor<const RayHit&> visit) noexcept {
    RayOnLattice moved;
    const QueryStatus status = begin(blob, ray.data(), moved);
    if (status != QueryStatus::ok) return of_list(status);
    return ESPALIER_DISPATCH_RAY(every_hit_on_lattice, data_of(blob), moved, visit);
}

QueryStatus for_each_crossing(const Blob& blob, const RoundedRay& ray, Visitor<const RayHit&> visit) noexcept {
    RayOnLattice moved;
    const QueryStatus status = begin(blob, ray.data(), moved);
    if (status != QueryStatus::ok) return of_list(status);
    return ESPALIER_DISPATCH_RAY(every_crossing_on_lattice, data_of(blob), moved, visit);
}

RoundedRay to_local(const Transform& transform, const RoundedRay& ray) noexcept {
    RoundedRay moved = ray;
    if (!ray) return moved;
    RoundedRayData& data = moved.data_;
    data.status = move_region(transform, data.region);
    return data.status == QueryStatus::ok ? moved : RoundedRay(data.status);
}

void detail::shorten(RoundedRay& ray, float t_max) noexcept {
    RoundedRayData& data = ray.data_;
    if (!(t_max < data.t_max) || data.may_hit == 0) return;
    const float tau_max = lattice_ray::to_tau(t_max, data.t_exponent) - data.tau_offset;
    if (tau_max < data.tau_min) {
        data.may_hit = 0;
        return;
    }
    data.tau_max = minimum(tau_max, data.tau_max);
    data.t_max = t_max;
}

}  // namespace espalier
