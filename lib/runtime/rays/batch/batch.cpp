// Batches of rays: the variant that suits the machine.
#include <espalier/ray.hpp>
#include <runtime/rays/queries.hpp>

#define ESPALIER_FRAGMENT <runtime/rays/batch/groups.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns ok where a batch may write: the blob is open, and there is a place for each answer.
QueryStatus check_batch(const Blob& blob, std::size_t rays, std::size_t places) {
    if (nothing_in(data_of(blob)) == QueryStatus::not_open) return QueryStatus::not_open;
    return rays == places ? QueryStatus::ok : QueryStatus::invalid_argument;
}

}  // namespace

Filled raycast(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) noexcept {
    const QueryStatus status = check_batch(blob, rays.size(), hits.size());
    if (status != QueryStatus::ok) return {0, {}, status};
    if (blob.triangle_count() == 0) scalar::closest_hits(data_of(blob), rays.data(), hits.data(), hits.size());
    else ESPALIER_DISPATCH(closest_hits, data_of(blob), rays.data(), hits.data(), hits.size());
    return {hits.size(), {}, status};
}

Filled occluded(const Blob& blob, std::span<const Ray> rays, std::span<YesNo> answers) noexcept {
    const QueryStatus status = check_batch(blob, rays.size(), answers.size());
    if (status != QueryStatus::ok) return {0, {}, status};
    if (blob.triangle_count() == 0) scalar::any_hits(data_of(blob), rays.data(), answers.data(), answers.size());
    else ESPALIER_DISPATCH(any_hits, data_of(blob), rays.data(), answers.data(), answers.size());
    return {answers.size(), {}, status};
}

}  // namespace espalier
