// Two blobs in the caller's units: placed on one grid, answered there, translated back.
#include <espalier/collide.hpp>
#include <runtime/copies.hpp>
#include <runtime/find_triangle.hpp>
#include <runtime/leaf_kinds.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/pair_queries.hpp>
#include <runtime/simd/dispatch.hpp>
#include <runtime/square_root.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Two blobs on their grid, or why there is no asking.
struct PlacedPair {
    PairFrame frame;
    QueryStatus status = QueryStatus::ok;
    bool is_empty;  ///< nothing to be found

    PlacedPair(const Blob& a, const Blob& b, const Placement& placement)
        : is_empty(a.triangle_count() == 0 || b.triangle_count() == 0) {
        if (!is_empty) status = place_pair(a.data(), b.data(), placement, frame);
        else if (!is_valid(placement)) status = QueryStatus::invalid_argument;
    }
};

/// The triangles that a pair stands for, where it is one of copies.
TrianglePair owners(const PairFrame& frame, const TrianglePair& pair) {
    return {{owner_of(*frame.a, pair.a.index)}, {owner_of(*frame.b, pair.b.index)}};
}

#if ESPALIER_PREDICTED_STRIPS
bool has_predicted_leaves(const PairFrame& frame) {
    return detail::has_predicted_leaves(frame.a->profile) || detail::has_predicted_leaves(frame.b->profile);
}
// With room for vertices, which pairs without predicted strips do not pay for.
[[gnu::noinline]] QueryStatus visit_touching_predicted(PairFrame& frame, OnTouching visit, std::uint64_t& work) {
    PredictedVertices vertices[2];
    frame.vertices = vertices;
    return ESPALIER_DISPATCH(touching_pairs, frame, visit, work);
}
[[gnu::noinline]] QueryStatus find_nearest_predicted(PairFrame& frame, float radius, bool any, FoundTriangles& best,
                                                     bool& found, std::uint64_t& work) {
    PredictedVertices vertices[2];
    frame.vertices = vertices;
    return ESPALIER_DISPATCH(nearest_pair, frame, radius, any, best, found, work);
}
#endif

QueryStatus visit_touching(PairFrame& frame, OnTouching visit, std::uint64_t& work) {
#if ESPALIER_PREDICTED_STRIPS
    if (has_predicted_leaves(frame)) return visit_touching_predicted(frame, visit, work);
#endif
    return ESPALIER_DISPATCH(touching_pairs, frame, visit, work);
}

QueryStatus find_touching(PairFrame& frame, TrianglePair& pair, bool& found, std::uint64_t& work) {
    const auto keep = [&](const TrianglePair& touching) {
        pair = touching;
        found = true;
        return stop;
    };
    return visit_touching(frame, keep, work);
}

/// Where the triangles of a pair touch. What this takes of the stack is not needed beside the walk.
[[gnu::noinline]] void find_common_point(const PairFrame& frame, FoundTriangles& touching) {
    touching.a = frame.place_a(find_triangle(*frame.a, touching.pair.a.index));
    touching.b = frame.place_b(find_triangle(*frame.b, touching.pair.b.index));
    touching.distance = distance_between(touching.a, touching.b);
    touching.pair = owners(frame, touching.pair);
}

/// From farther away than this many times their size too many pairs are equally near, as far as floats tell.
constexpr float farthest_in_spans = 1024.0f;

/// Pairs at distance 0 are looked for apart: what separates boxes finds them sooner than how far apart these are.
QueryStatus find_nearest(PairFrame& frame, float radius, bool any, FoundTriangles& best, bool& found,
                         std::uint64_t work) {
    if (frame.gap > farthest_in_spans * frame.span)
        return frame.gap > 2.0f * radius ? QueryStatus::ok : QueryStatus::out_of_range;
    const QueryStatus status = find_touching(frame, best.pair, found, work);
    if (found) find_common_point(frame, best);
    if (found || status != QueryStatus::ok || radius == 0.0f) return status;
#if ESPALIER_PREDICTED_STRIPS
    if (has_predicted_leaves(frame)) return find_nearest_predicted(frame, radius, any, best, found, work);
#endif
    return ESPALIER_DISPATCH(nearest_pair, frame, radius, any, best, found, work);
}

/// A point of a triangle of the grid, in a's space.
Vec3 point_in_world(const PairFrame& frame, const LatticeTriangle& triangle, const float* weights) {
    float steps[3];
    point_of(triangle, weights[0], weights[1], steps);
    for (float& step : steps) step = scale_by_power_of_two(step, frame.shift);
    return to_world(*frame.a, steps[0], steps[1], steps[2]);
}

/// A distance in steps of the grid. No two triangles of it are apart by less than 2^-60 and more than 0.
float radius_on_grid(const PairFrame& frame, float distance) {
    const float radius = scale_by_power_of_two(distance, -(frame.a->step_exponent + frame.shift));
    return magnitude_bits(distance) != 0 && radius < 0x1p-60f ? 0x1p-60f : radius;
}

bool is_distance(float distance) {
    return !is_nan(distance) && (!is_negative(distance) || magnitude_bits(distance) == 0);
}

}  // namespace

QueryStatus first_contact(const Blob& a, const Blob& b, const Placement& placement, TrianglePair& contact, bool& found,
                          WorkLimit limit) noexcept {
    PlacedPair placed(a, b, placement);
    if (placed.status != QueryStatus::ok) return placed.status;
    found = false;
    if (placed.is_empty) return QueryStatus::ok;
    TrianglePair pair;
    const QueryStatus status = find_touching(placed.frame, pair, found, limit.pairs);
    if (found) contact = owners(placed.frame, pair);
    return status;
}

QueryStatus collides(const Blob& a, const Blob& b, const Placement& placement, bool& answer, WorkLimit limit) noexcept {
    TrianglePair contact;
    return first_contact(a, b, placement, contact, answer, limit);
}

QueryStatus for_each_contact(const Blob& a, const Blob& b, const Placement& placement,
                             FunctionRef<Visit(const TrianglePair&)> visit, WorkLimit limit) {
    if (a.copy_count() != 0 || b.copy_count() != 0) return QueryStatus::has_copies;
    PlacedPair placed(a, b, placement);
    if (placed.is_empty || placed.status != QueryStatus::ok) return placed.status;
    return visit_touching(placed.frame, visit, limit.pairs);
}

QueryStatus all_contacts(const Blob& a, const Blob& b, const Placement& placement, std::span<TrianglePair> contacts,
                         std::size_t& count, WorkLimit limit) noexcept {
    std::size_t written = 0;
    bool is_full = false;
    const auto write = [&](const TrianglePair& pair) {
        is_full = written == contacts.size();
        if (is_full) return stop;
        contacts[written++] = pair;
        return keep_going;
    };
    const QueryStatus status = for_each_contact(a, b, placement, write, limit);
    if (status != QueryStatus::ok && status != QueryStatus::work_limit) return status;
    count = written;
    return is_full ? QueryStatus::output_full : status;
}

QueryStatus minimum_distance(const Blob& a, const Blob& b, const Placement& placement, float max_distance,
                             PairDistance& nearest, bool& found, WorkLimit limit) noexcept {
    if (!is_distance(max_distance)) return QueryStatus::invalid_argument;
    PlacedPair placed(a, b, placement);
    if (placed.status != QueryStatus::ok) return placed.status;
    found = false;
    if (placed.is_empty) return QueryStatus::ok;
    PairFrame& frame = placed.frame;
    FoundTriangles best;
    const QueryStatus status =
        find_nearest(frame, radius_on_grid(frame, max_distance), false, best, found, limit.pairs);
    if (!found) return status;
    const float distance =
        scale_by_power_of_two(square_root(best.distance.squared), frame.shift + a.data().step_exponent);
    // That it is within max_distance was decided exactly; rounding must not say otherwise.
    nearest = {magnitude_bits(distance) > magnitude_bits(max_distance) ? max_distance : distance,
               point_in_world(frame, best.a, best.distance.on_a), point_in_world(frame, best.b, best.distance.on_b),
               best.pair};
    return status;
}

QueryStatus within_distance(const Blob& a, const Blob& b, const Placement& placement, float distance, bool& answer,
                            WorkLimit limit) noexcept {
    if (!is_distance(distance)) return QueryStatus::invalid_argument;
    PlacedPair placed(a, b, placement);
    if (placed.status != QueryStatus::ok) return placed.status;
    answer = false;
    if (placed.is_empty) return QueryStatus::ok;
    FoundTriangles pair;
    return find_nearest(placed.frame, radius_on_grid(placed.frame, distance), true, pair, answer, limit.pairs);
}

}  // namespace espalier
