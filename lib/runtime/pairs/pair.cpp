// Queries of two blobs in world space: placed on one grid, decided there, translated back.
#include <runtime/answers/answer.hpp>
#include <runtime/answers/first_reference.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/pairs/contacts.hpp>

#define ESPALIER_FRAGMENT <runtime/pairs/search.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Two blobs on their common grid.
struct PlacedPair {
    PairFrame frame;
    QueryStatus status;  ///< ok; not_found: a blob has no triangles, or is too far; or why the query is refused

    /// Wherever they are; but with a work limit for what is within a distance of the world, two whose bounds are
    /// farther apart are left alone after one visit.
    PlacedPair(const PlacedBlob& a, const PlacedBlob& b, float distance = 0.0f, std::uint64_t* work = nullptr)
        : status(place(a, b, distance, work)) {}

private:
    /// Out of line: its stack is not needed beside the walk.
    ESPALIER_NOINLINE QueryStatus place(const PlacedBlob& a, const PlacedBlob& b, float distance, std::uint64_t* work) {
        const BlobData& data_a = data_of(a.blob());
        const BlobData& data_b = data_of(b.blob());
        if (data_a.bytes == nullptr || data_b.bytes == nullptr) return QueryStatus::not_open;
        if (!is_valid(a.transform()) || !is_valid(b.transform())) return QueryStatus::invalid_argument;
        if (data_a.triangle_count == 0 || data_b.triangle_count == 0) return QueryStatus::not_found;
        const Transform b_in_a = to_local(a.transform(), b.transform());
        if (!is_valid(b_in_a)) return QueryStatus::out_of_range;
        if (work != nullptr && *work != 0 && is_radius(distance) &&
            are_apart(data_a, data_b, b_in_a, converted(distance, a.transform().scale, false))) {
            --*work;
            return QueryStatus::not_found;
        }
        return place_pair(data_a, data_b, b_in_a, frame);
    }
};

#if ESPALIER_PREDICTED_STRIPS
/// Out of line: pairs without predicted strips do not pay for the room.
ESPALIER_NOINLINE QueryStatus search_with_vertices(PairFrame& frame, const PairSearch& search, std::uint64_t& work) {
    PredictedVertices vertices[2];
    frame.vertices = vertices;
    return ESPALIER_DISPATCH(search_pairs, frame, search, work);
}
#endif

/// With the instruction set that suits the machine, and room for the vertices of predicted strips where a blob has
/// such.
QueryStatus search_pair(PairFrame& frame, const PairSearch& search, std::uint64_t& work) {
#if ESPALIER_PREDICTED_STRIPS
    if (has_predicted_leaves(frame.a->profile) || has_predicted_leaves(frame.b->profile))
        return search_with_vertices(frame, search, work);
#endif
    return ESPALIER_DISPATCH(search_pairs, frame, search, work);
}

QueryStatus find_touching(PairFrame& frame, TrianglePair& pair, bool& found, PairWork& work) {
    const auto keep = [&](const TrianglePair& touching, const PlaceTriangles&) {
        pair = touching;
        found = true;
        return Visit::stop;
    };
    return search_pair(frame, {.on_touching = keep, .counters = work.counters}, work.left);
}

/// Where the triangles of a pair touch. What this takes of the stack is not needed beside the walk.
ESPALIER_NOINLINE void find_common_point(const PairFrame& frame, FoundTriangles& touching) {
    touching.a = frame.place_a(find_triangle(*frame.a, touching.pair.a.index));
    touching.b = frame.place_b(find_triangle(*frame.b, touching.pair.b.index));
    touching.distance = distance_between(touching.a, touching.b);
    touching.pair = owners(frame, touching.pair);
}

/// From farther away than this many times their size too many pairs are equally near, as far as floats tell.
constexpr float farthest_in_spans = 1024.0f;

/// Searches for touching pairs first: separating axes find them sooner than distances between boxes do.
ESPALIER_ALWAYS_INLINE inline QueryStatus find_nearest(PairFrame& frame, LeastDistance& least, PairWork& work) {
    if (frame.gap > farthest_in_spans * frame.span)
        return frame.gap > 2.0f * least.radius ? QueryStatus::ok : QueryStatus::out_of_range;
    const QueryStatus status = find_touching(frame, least.best.pair, least.found, work);
    if (least.found) find_common_point(frame, least.best);
    if (least.found || status != QueryStatus::ok || least.radius == 0.0f) return status;
    return search_pair(frame, {.least = &least, .counters = work.counters}, work.left);
}

/// A distance in steps of the grid. No two triangles of it are apart by less than 2^-60 and more than 0.
float radius_on_grid(const PairFrame& frame, float distance) {
    const float radius = scale_by_power_of_two(distance, -(frame.a->step_exponent + frame.shift));
    return magnitude_bits(distance) != 0 && radius < 0x1p-60f ? 0x1p-60f : radius;
}

Vec3 place_of(const LatticeTriangle& triangle, const Weights& weights) {
    return point_of(triangle, weights.u, weights.v);
}

/// A search for the nearest pair, or for any within a distance.
struct NearestSearch {
    PlacedPair placed;
    LeastDistance least;
    QueryStatus status;

    NearestSearch(const PlacedBlob& a, const PlacedBlob& b, float distance, bool any, PairWork& work)
        : placed(a, b, distance, &work.left), least{placed.frame, 0.0f, any}, status(placed.status) {
        if (status != QueryStatus::not_open && !is_radius(distance)) status = QueryStatus::invalid_argument;
        if (status != QueryStatus::ok) return;
        PairFrame& frame = placed.frame;
        least.set_radius(radius_on_grid(frame, converted(distance, a.transform().scale, false)));
        status = find_nearest(frame, least, work);
        if (!least.found && status == QueryStatus::ok) status = QueryStatus::not_found;
    }
};

/// Looks for lower references to the triangles of a pair that touch where the walk comes to them: walks again, only
/// through boxes that both triangles touch. Returns ok if there are none, stopped at the first, or work_limit.
ESPALIER_NOINLINE QueryStatus find_lower_references(const PairFrame& on_grid, const TrianglePair& references,
                                                    std::uint64_t& work) {
    PairFrame frame = on_grid;  // the walk that waits uses its room for vertices
    const ReferredTriangles only = {owners(frame, references),
                                    {bounds_of(find_triangle(*frame.a, references.a.index)),
                                     bounds_of(find_triangle(*frame.b, references.b.index))}};
    bool is_found = false;
    const auto compare = [&](const TrianglePair& others, const PlaceTriangles&) {
        is_found = others < references && owners(frame, others) == only.triangles;
        return is_found ? Visit::stop : Visit::next;
    };
    const QueryStatus status = search_pair(frame, {.on_touching = compare, .only = &only}, work);
    return is_found ? QueryStatus::stopped : status;
}

/// Calls visit(frame, contact, references, place) once for each pair that touches; if `before` is set, only for those
/// after it. It holds what it needs itself: a lambda with references to all of it takes more of the stack.
struct ContactVisitor {
    PairFrame& frame;
    const TrianglePair* before;
    OnContact visit;
    std::uint64_t work;
    bool is_behind = before == nullptr;
    QueryStatus end = QueryStatus::ok;  ///< else why it stopped the walk

    Visit operator()(const TrianglePair& references, const PlaceTriangles& place) {
        if (!is_behind) {
            is_behind = references == *before;
            return Visit::next;
        }
        const TrianglePair pair = owners(frame, references);
        if (reads_duplicate_references && pair != references) {
            const QueryStatus lower = find_lower_references(frame, references, work);
            if (lower == QueryStatus::stopped) return Visit::next;
            end = lower;
        }
        if (end == QueryStatus::ok && visit(frame, {pair.a, pair.b, QueryStatus::ok}, references, place) == Visit::stop)
            end = QueryStatus::stopped;
        return end == QueryStatus::ok ? Visit::next : Visit::stop;
    }
    /// Returns ok, stopped, work_limit, or invalid_argument if the walk does not come to `before`.
    QueryStatus walk() {
        const QueryStatus status = search_pair(frame, {.on_touching = *this, .from = before}, work);
        if (end != QueryStatus::ok) return end;
        return status == QueryStatus::ok && !is_behind ? QueryStatus::invalid_argument : status;
    }
};

/// A cursor is the last pair that was written.
Cursor cursor_behind(const TrianglePair& pair) { return {{pair.a.index, pair.b.index, 1}}; }
TrianglePair pair_before(const Cursor& cursor) { return {{cursor.place[0]}, {cursor.place[1]}}; }
bool is_valid_cursor(const Cursor& cursor, const PairFrame& frame) {
    return cursor.place[0] < frame.a->triangle_count && cursor.place[1] < frame.b->triangle_count &&
           cursor.place[2] == 1;
}

}  // namespace

ESPALIER_NOINLINE PairContact detail::find_first_contact(const PlacedBlob& a, const PlacedBlob& b,
                                                         PairWork& work) noexcept {
    PairContact contact;
    PlacedPair placed(a, b, 0.0f, &work.left);
    contact.status = placed.status;
    if (placed.status != QueryStatus::ok) return contact;
    TrianglePair pair;
    bool found = false;
    contact.status = find_touching(placed.frame, pair, found, work);
    if (found) {
        pair = owners(placed.frame, pair);
        contact.a = pair.a;
        contact.b = pair.b;
    } else if (contact.status == QueryStatus::ok) {
        contact.status = QueryStatus::not_found;
    }
    return contact;
}

PairContact first_contact(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit) noexcept {
    PairWork work = {limit.visits()};
    return find_first_contact(a, b, work);
}

PairContact first_contact(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit, PairCounters& counters) noexcept {
    PairWork work = {limit.visits(), &counters};
    const PairContact contact = find_first_contact(a, b, work);
    counters.box_pairs += limit.visits() - work.left;
    return contact;
}

YesNo overlaps(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit) noexcept {
    return YesNo(first_contact(a, b, limit).status);
}

QueryStatus for_each_contact(const PlacedBlob& a, const PlacedBlob& b, Visitor<const PairContact&> visit,
                             WorkLimit limit) noexcept {
    const auto pass_on = [&](const PairFrame&, const PairContact& contact, const TrianglePair&, const PlaceTriangles&) {
        return visit(contact);
    };
    return visit_contacts(a, b, pass_on, limit);
}

Filled collect_contacts(const PlacedBlob& a, const PlacedBlob& b, std::span<PairContact> contacts, WorkLimit limit,
                        Cursor from) noexcept {
    const auto write = [&](std::size_t place, const PairFrame&, const PairContact& contact, const PlaceTriangles&) {
        contacts[place] = contact;
    };
    return collect_contacts(a, b, contacts.size(), write, limit, from);
}

QueryStatus detail::visit_contacts(const PlacedBlob& a, const PlacedBlob& b, OnContact visit,
                                   WorkLimit limit) noexcept {
    std::uint64_t work = limit.visits();
    PlacedPair placed(a, b, 0.0f, &work);
    if (placed.status != QueryStatus::ok) return of_list(placed.status);
    return ContactVisitor{placed.frame, nullptr, visit, work}.walk();
}

Filled detail::collect_contacts(const PlacedBlob& a, const PlacedBlob& b, std::size_t capacity, WriteContact write,
                                WorkLimit limit, const Cursor& from) noexcept {
    Filled filled;
    filled.next = from;
    const bool begins = from == Cursor{};
    std::uint64_t work = limit.visits();
    PlacedPair placed(a, b, 0.0f, begins ? &work : nullptr);  // a cursor of other placements is refused by the walk
    filled.status = of_list(placed.status);
    if (placed.status != QueryStatus::ok) return filled;
    if (!begins && !is_valid_cursor(from, placed.frame)) {
        filled.status = QueryStatus::invalid_argument;
        return filled;
    }
    const TrianglePair before = pair_before(from);
    const auto keep = [&](const PairFrame& frame, const PairContact& contact, const TrianglePair& references,
                          const PlaceTriangles& place) {
        if (filled.count == capacity) return Visit::stop;
        write(filled.count++, frame, contact, place);
        filled.next = cursor_behind(references);
        return Visit::next;
    };
    filled.status = ContactVisitor{placed.frame, begins ? nullptr : &before, keep, work}.walk();
    if (filled.status == QueryStatus::stopped) filled.status = QueryStatus::output_full;
    return filled;
}

QueryStatus detail::place_triangles(const PlacedBlob& a, const PlacedBlob& b, const PairContact& pair, PairFrame& frame,
                                    LatticeTriangle& of_a, LatticeTriangle& of_b) noexcept {
    const PlacedPair placed(a, b);
    if (placed.status == QueryStatus::not_open || is_refused(placed.status)) return placed.status;
    if (pair.a.index >= data_of(a.blob()).triangle_count || pair.b.index >= data_of(b.blob()).triangle_count)
        return QueryStatus::invalid_argument;
    frame = placed.frame;
    of_a = frame.place_a(find_triangle(*frame.a, pair.a.index));
    of_b = frame.place_b(find_triangle(*frame.b, pair.b.index));
    return QueryStatus::ok;
}

namespace {

/// Part of its callers: a frame of its own takes stack where no counters are given.
ESPALIER_ALWAYS_INLINE inline BlobDistance find_distance(const PlacedBlob& a, const PlacedBlob& b, float max_distance,
                                                         PairWork& work) {
    BlobDistance result;
    const NearestSearch search(a, b, max_distance, false, work);
    result.status = search.status;
    if (!search.least.found) return result;
    const PairFrame& frame = search.placed.frame;
    const FoundTriangles& best = search.least.best;
    const float in_world = length_in_world(frame, square_root(best.distance.squared), a.transform().scale);
    // That it is within max_distance was decided exactly; rounding does not change that.
    result.distance = magnitude_bits(in_world) > magnitude_bits(max_distance) ? max_distance : in_world;
    result.on_a = to_world(a.transform(), point_in_units(frame, place_of(best.a, best.distance.on_a)));
    result.on_b = to_world(a.transform(), point_in_units(frame, place_of(best.b, best.distance.on_b)));
    result.a = best.pair.a;
    result.b = best.pair.b;
    return result;
}

}  // namespace

BlobDistance distance(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit, float max_distance) noexcept {
    PairWork work = {limit.visits()};
    return find_distance(a, b, max_distance, work);
}

BlobDistance distance(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit, float max_distance,
                      PairCounters& counters) noexcept {
    PairWork work = {limit.visits(), &counters};
    const BlobDistance result = find_distance(a, b, max_distance, work);
    counters.box_pairs += limit.visits() - work.left;
    return result;
}

YesNo within_distance(const PlacedBlob& a, const PlacedBlob& b, float distance, WorkLimit limit) noexcept {
    PairWork work = {limit.visits()};
    return YesNo(NearestSearch(a, b, distance, true, work).status);
}

}  // namespace espalier
