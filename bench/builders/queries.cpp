#include "queries.hpp"

#include <bit>
#include <stdexcept>

#include <espalier/pair.hpp>

#include "../deformation/processor_time.hpp"
#include "../pairs/poses.hpp"
#include "../rays.hpp"

namespace espalier::bench {
namespace {

constexpr std::uint64_t seed = 2026;

/// Whether the blob touches a second one of its kind in the pose. Throws where the query is refused.
bool touches(const Blob& blob, const Transform& pose, PairCounters& counters) {
    const PairContact contact = first_contact(blob, {blob, pose}, WorkLimit::unlimited(), counters);
    if (is_refused(contact.status)) throw std::runtime_error(describe(contact.status));
    return static_cast<bool>(contact);
}
bool touches(const Blob& blob, const Transform& pose) {
    PairCounters unused;
    return touches(blob, pose, unused);
}

}  // namespace

Queries::Queries(const tests::Mesh& mesh, const Blob& blob, const QueryCounts& counts)
    : rays_(incoherent_rays(mesh, counts.rays, seed)),
      poses_(some_poses(mesh, counts.poses, seed, [&](const Transform& pose) { return touches(blob, pose); })) {}

Work Queries::count(const Blob& blob) const {
    Work work;
    for (const Ray& ray : rays_) {
        const RayHit hit = raycast(blob, ray, work.rays);
        work.answers = 31 * work.answers + (hit ? std::bit_cast<std::uint32_t>(hit.t) : 1);
    }
    for (const Transform& pose : poses_) {
        const bool is_touching = touches(blob, pose, work.pairs);
        work.answers = 31 * work.answers + (is_touching ? 1 : 0);
        work.touching_poses += is_touching ? 1 : 0;
    }
    return work;
}

Seconds Queries::time(const Blob& blob) const {
    Seconds seconds;
    const ProcessorTime ray_time;
    for (const Ray& ray : rays_) static_cast<void>(raycast(blob, ray));
    seconds.rays = ray_time.seconds();
    const ProcessorTime pair_time;
    for (const Transform& pose : poses_) static_cast<void>(touches(blob, pose));
    seconds.pairs = pair_time.seconds();
    return seconds;
}

}  // namespace espalier::bench
