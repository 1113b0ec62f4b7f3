#include "rounded_ray_loop.hpp"

#include "support/machine/instruction_paths.hpp"

#include <runtime/kernels/ray_triangle.hpp>

namespace espalier::tests {
namespace {

/// The ray in steps that begin so many steps later.
detail::IntegerRay integer_ray(const detail::RoundedRayData& data, const Steps& before) {
    detail::IntegerRay ray{};
    for (int k = 0; k < 3; ++k) {
        ray.origin[k] = data.origin[k] - before[k] * (1 << data.fraction_bits);
        ray.direction[k] = data.direction[k];
    }
    ray.fraction_bits = data.fraction_bits;
    ray.t_exponent = data.t_exponent;
    ray.tau_min = data.tau_min;
    ray.tau_max = data.tau_max;
    ray.tau_offset = data.tau_offset;
    ray.culling = data.culling;
    return ray;
}

/// In the region's own steps: nothing is moved onto the blob.
RayHit loop_over_triangles(const DecodedBlob& decoded, const Steps& before, const RoundedRay& rounded) {
    const detail::RoundedRayData& data = rounded.data();
    RayHit best;
    best.status = QueryStatus::not_found;
    if (data.may_hit == 0) return best;
    const detail::IntegerRay ray = integer_ray(data, {});
    detail::TriangleHit nearest{};
    nearest.whole_tau = INFINITY;
    for (std::uint32_t i = 0; i < decoded.triangles.size(); ++i) {
        if (decoded.owners.size() > i && decoded.owners[i] != i) continue;
        const GridPoint* corners[3] = {&decoded.triangles[i].a, &decoded.triangles[i].b, &decoded.triangles[i].c};
        detail::LatticeTriangle triangle{};
        for (int corner = 0; corner < 3; ++corner)
            for (int k = 0; k < 3; ++k)
                triangle.corner[corner][k] = (*corners[corner])[static_cast<std::size_t>(k)] + before[k];
        detail::TriangleHit hit{};
        if (!detail::intersect(ray, triangle, hit)) continue;
        if (best.triangle != no_triangle && !(hit.whole_tau < nearest.whole_tau)) continue;
        nearest = hit;
        Ray window = {.origin = {}, .direction = {}, .t_min = data.t_min, .t_max = data.t_max};
        best = detail::to_ray_hit(ray, window, hit, i);
    }
    return best;
}

detail::RayOnLattice moved(const RoundedRay& rounded, const Steps& before) {
    const detail::RoundedRayData& data = rounded.data();
    detail::RayOnLattice result{};
    static_cast<detail::IntegerRay&>(result.ray) = integer_ray(data, before);
    detail::set_longest_axis(result.ray, data.longest_axis);
    result.t_min = data.t_min;
    result.t_max = data.t_max;
    return result;
}

/// Requires that the closest hit is listed and none before it, and the same of a filter that drops it.
void require_list_and_filter(const Blob& blob, const RoundedRay& ray, const RayHit& closest) {
    std::vector<RayHit> hits;
    const QueryStatus status = for_each_hit(blob, ray, [&](const RayHit& hit) { hits.push_back(hit); });
    REQUIRE(status == (is_refused(closest.status) ? closest.status : QueryStatus::ok));
    // Of hits that round to one t the closest may be any: t is compared before it is rounded.
    const auto require_first = [&](const RayHit& first) {
        REQUIRE(hits.empty() == !first);
        const auto is_first = [&](const RayHit& hit) { return same_bits(hit, first); };
        const auto is_closer = [&](const RayHit& hit) { return hit.t < first.t; };
        if (first) REQUIRE(std::any_of(hits.begin(), hits.end(), is_first));
        if (first) REQUIRE(std::none_of(hits.begin(), hits.end(), is_closer));
    };
    require_first(closest);
    if (!closest) return;
    const auto keep = [&](TriangleId triangle) { return triangle != closest.triangle; };
    std::erase_if(hits, [&](const RayHit& hit) { return hit.triangle == closest.triangle; });
    const RayHit next = raycast(blob, ray, keep);
    require_first(next);
    REQUIRE(occluded(blob, ray, keep).status() == next.status);
}

}  // namespace

RayHit require_answers_of_the_loop(const DecodedBlob& decoded, const Blob& blob, const RoundedRay& ray,
                                   const Steps& before) {
    const RayHit expected = loop_over_triangles(decoded, before, ray);
    REQUIRE(same_bits(raycast(blob, ray), expected));
    REQUIRE(occluded(blob, ray).status() == expected.status);
    require_list_and_filter(blob, ray, expected);
    if (ray.data().may_hit == 0) return expected;
    const detail::RayOnLattice on_blob = moved(ray, before);
    for (const InstructionPath& path : instruction_paths()) {
        const RayHit path_hit = path.closest_hit_on_lattice(detail::data_of(blob), on_blob, {});
        REQUIRE_MESSAGE(same_bits(path_hit, expected), std::string(path.name));
        REQUIRE_MESSAGE(path.any_hit_on_lattice(detail::data_of(blob), on_blob, {}).status() == expected.status,
                        std::string(path.name));
    }
    return expected;
}

}  // namespace espalier::tests
