#include "instruction_paths.hpp"

#include "chosen_instruction_set.hpp"

/// By the name of the one that single rays take, and of the one for everything else.
#define ESPALIER_PATH_OF(rays, set)                                                                                 \
    InstructionPath {                                                                                               \
#rays, detail::rays::closest_hit, detail::rays::first_hits, detail::rays::any_hit, detail::rays::every_hit, \
            detail::rays::every_crossing, detail::set::closest_hits, detail::set::any_hits,                         \
            detail::set::find_overlaps, detail::set::find_nearest, detail::rays::may_hit,                           \
            detail::rays::closest_hit_on_lattice, detail::rays::any_hit_on_lattice, detail::set::search_pairs       \
    }
#define ESPALIER_PATH(set) ESPALIER_PATH_OF(set, set)

namespace espalier::tests {

const std::vector<InstructionPath>& instruction_paths() {
    static const std::vector<InstructionPath> paths = [] {
        std::vector<InstructionPath> found = {ESPALIER_PATH(scalar), ESPALIER_PATH_OF(small, scalar)};
#if ESPALIER_X86
        const detail::InstructionSet best = best_instruction_set();
        using detail::InstructionSet;  // each has all of those before it
#if ESPALIER_HAS_SSE42
        if (best >= InstructionSet::sse42) found.push_back(ESPALIER_PATH(sse42));
#endif
#if ESPALIER_HAS_AVX2
        if (best >= InstructionSet::avx2) found.push_back(ESPALIER_PATH(avx2));
#endif
#if ESPALIER_HAS_AVX512
        if (best >= InstructionSet::avx512) found.push_back(ESPALIER_PATH(avx512));
#endif
#elif ESPALIER_NEON
        found.push_back(ESPALIER_PATH(neon));
#elif ESPALIER_SIMD128
        found.push_back(ESPALIER_PATH(simd128));
#endif
        return found;
    }();
    return paths;
}

QueryStatus InstructionPath::touching_pairs(const detail::PairFrame& frame,
                                            FunctionRef<Visit(const detail::TrianglePair&)> visit,
                                            std::uint64_t& work) const {
    const auto pass_on = [&](const detail::TrianglePair& pair, const detail::PlaceTriangles&) { return visit(pair); };
    return search_pairs(frame, {.on_touching = pass_on}, work);
}

QueryStatus InstructionPath::nearest_pair(const detail::PairFrame& frame, float radius, bool any,
                                          detail::FoundTriangles& best, bool& found, std::uint64_t& work) const {
    detail::LeastDistance least = {frame, radius, any};
    const QueryStatus status = search_pairs(frame, {.least = &least}, work);
    best = least.best;
    found = least.found;
    return status;
}

bool InstructionPath::any_overlap(const detail::BlobData& blob, const detail::RoundedPoint& sphere) const {
    return !every_overlap(blob, sphere, 0, [](TriangleId) { return Visit::stop; });
}

bool InstructionPath::every_overlap(const detail::BlobData& blob, const detail::RoundedPoint& sphere,
                                    std::uint32_t first, FunctionRef<Visit(TriangleId)> visit) const {
    const TriangleVisitor visit_triangle(visit);
    detail::Each each(blob, visit_triangle);
    each.first = first;
    return !find_overlaps(blob, sphere, each, detail::exactly);
}

bool InstructionPath::closest_triangle(const detail::BlobData& blob, const detail::RoundedPoint& point,
                                       detail::FoundNearest& best) const {
    detail::Closest<detail::FoundNearest> closest(best);
    find_nearest(blob, point, closest, detail::exactly);
    return closest.found();
}

std::size_t InstructionPath::closest_triangles(const detail::BlobData& blob, const detail::RoundedPoint& point,
                                               std::span<ClosestPoint> nearest) const {
    detail::ClosestFew few(nearest);
    detail::NearestFew answer(blob, few);
    find_nearest(blob, point, answer, detail::exactly);
    return few.sorted().size();
}

bool InstructionPath::may_overlap(const detail::BlobData& blob, const detail::RoundedPoint& sphere, std::int32_t steps,
                                  QueryCounters& counters) const {
    const auto stop = [](TriangleId) { return Visit::stop; };
    const TriangleVisitor visit(stop);
    detail::Each any(blob, visit);
    return find_overlaps(blob, sphere, any, {steps, &counters});
}

detail::SquaredBounds InstructionPath::closest_bounds(const detail::BlobData& blob, const detail::RoundedPoint& point,
                                                      std::int32_t steps, QueryCounters& counters) const {
    detail::Bounds answer;
    find_nearest(blob, point, answer, {steps, &counters});
    return answer.squared;
}

}  // namespace espalier::tests
