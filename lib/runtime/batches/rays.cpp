// Rays in arrays.
#include <espalier/batches/rays.hpp>
#include <runtime/base/options.hpp>
#include <runtime/batches/fill.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Answers rays by a batch of rays, some at a time. Where a batch takes them one by one, so does this.
template <class Answer, class Batch>
Filled answer_in_pieces(const Blob& blob, const RayArrays& rays, std::span<Answer> answers, Batch batch) {
    constexpr std::size_t most = ESPALIER_SMALL_CODE ? 1 : 128;
    const QueryStatus status =
        check_results(check_arrays(blob, answers.size(), rays.origins, rays.directions), answers);
    if (status != QueryStatus::ok) return {0, {}, status};
    Ray piece[most];
    for (std::size_t first = 0; first < answers.size(); first += most) {
        const std::size_t left = answers.size() - first;
        const std::size_t count = left < most ? left : most;
        for (std::size_t i = 0; i < count; ++i) piece[i] = rays.at(first + i);
        batch(std::span<const Ray>(piece, count), answers.subspan(first, count));
    }
    return {answers.size(), {}, status};
}

}  // namespace

Filled raycast(const Blob& blob, const RayArrays& rays, std::span<RayHit> hits) noexcept {
    return answer_in_pieces(blob, rays, hits, [&](std::span<const Ray> piece, std::span<RayHit> answers) {
        (void)raycast(blob, piece, answers);
    });
}

Filled occluded(const Blob& blob, const RayArrays& rays, std::span<YesNo> answers) noexcept {
    return answer_in_pieces(blob, rays, answers, [&](std::span<const Ray> piece, std::span<YesNo> of_piece) {
        (void)occluded(blob, piece, of_piece);
    });
}

Filled closest_hits(const Blob& blob, const RayArrays& rays, std::span<RayHit> hits, std::span<Filled> found) noexcept {
    return fill_rows(check_arrays(blob, found.size(), rays.origins, rays.directions), hits, found,
                     [&](std::size_t i, std::span<RayHit> row) { return closest_hits(blob, rays.at(i), row); });
}

FilledLists collect_hits(const Blob& blob, const RayArrays& rays, std::span<QueryStatus> statuses,
                         std::span<std::size_t> offsets, std::span<RayHit> hits) noexcept {
    return fill_lists(check_arrays(blob, statuses.size(), rays.origins, rays.directions), statuses, offsets, hits,
                      [&](std::size_t i, auto visit) { return for_each_hit(blob, rays.at(i), visit); });
}

FilledLists collect_crossings(const Blob& blob, const RayArrays& rays, std::span<QueryStatus> statuses,
                              std::span<std::size_t> offsets, std::span<RayHit> crossings) noexcept {
    return fill_lists(check_arrays(blob, statuses.size(), rays.origins, rays.directions), statuses, offsets, crossings,
                      [&](std::size_t i, auto visit) { return for_each_crossing(blob, rays.at(i), visit); });
}

}  // namespace espalier
