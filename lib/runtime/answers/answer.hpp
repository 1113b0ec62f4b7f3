// What becomes of the triangles that a shape finds: each answer is written once, for all shapes.
#pragma once

#include <cstdint>

#include <espalier/base/function_ref.hpp>
#include <espalier/distance.hpp>
#include <espalier/advanced/statistics.hpp>
#include <espalier/types.hpp>
#include <runtime/answers/best_k.hpp>
#include <runtime/answers/found.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/answers/first_reference.hpp>

namespace espalier::detail {

/// How far an answer may be off, and who counts the work for it: parameters of every walk.
struct WalkAccuracy {
    std::int32_t steps = -1;  ///< a box no longer than this along every axis stands for what is in it; below 0: none
    QueryCounters* counters = nullptr;

    [[nodiscard]] bool is_exact() const { return steps < 0 && counters == nullptr; }
};
inline constexpr WalkAccuracy exactly;

/// Returns the status of a list, given that of a single answer: a list without elements is complete.
constexpr QueryStatus of_list(QueryStatus status) {
    return status == QueryStatus::not_found ? QueryStatus::ok : status;
}

/// What shapes and walks read of an answer, and how they call one of unknown type.
struct Answer {
    static constexpr std::uint32_t no_index = ~std::uint32_t{0};
    using OnFound = Visit (*)(Answer& self, const Found& found);
    using OnBox = void (*)(Answer& self, float lower, float upper);

    OnFound on_found;
    OnBox on_box;            ///< takes the keys between which a small box lies; without it the first one ends the walk
    float limit = infinity;  ///< boxes with larger keys do not matter
    float worst = infinity;  ///< triangles with larger keys do not matter
    std::uint32_t last = no_index;  ///< nor do those with that key from this index on
    std::uint32_t first = 0;        ///< triangles with smaller storage indices are passed over undecided

    explicit Answer(OnFound take_found = nullptr, OnBox take_box = nullptr) : on_found(take_found), on_box(take_box) {}

    [[nodiscard]] bool rules_out(float key, std::uint32_t index) const {
        // mutant(> -> >=) work: decides triangles that are as near as the best and come behind it
        return key > worst || (key == worst && index >= last);
    }
    Visit take(const Found& found) { return on_found(*this, found); }
    void lower_limit(float squared) { limit = minimum(squared * distance_slack, limit); }
};

/// Calls a visitor with each triangle, which may stop the walk.
struct Each : Answer {
    using IsFirst = bool (*)(const BlobData& blob, std::uint32_t reference, ReachedChildren reached);
    using OnTriangle = Visit (*)(Each& self, std::uint32_t index, const LatticeTriangle& triangle);

    const BlobData& blob;
    IsFirst is_first;  ///< returns whether a triangle comes at this duplicate reference; null: at each of them
    TriangleVisitor visit;
    OnTriangle on_triangle;  ///< takes triangles in place of `visit`, if it is not null
    TriangleId* out;         ///< triangles are written here, up to `out_end`, in place of a call, if it is not null
    TriangleId* out_end;
    ReachedChildren reached;  ///< the walk, for triangles with duplicate references

    /// Without `with_first` a triangle comes at each reference: a program then does not link the search for the first.
    Each(const BlobData& from, const TriangleVisitor& with_each, IsFirst with_first = is_first_reference)
        : Answer([](Answer& self, const Found& found) { return static_cast<Each&>(self).take(found); }),
          blob(from),
          is_first(with_first),
          visit(with_each),
          on_triangle(nullptr),
          out(nullptr),
          out_end(nullptr) {}
    Visit take(const Found& found) {
        if (!comes_here(found)) return Visit::next;
        if (takes_shortcut(out != out_end)) {
            *out++ = TriangleId{found.index};
            return Visit::next;
        }
        return keep_place(found, visit(TriangleId{found.index}, blob, found.reference));
    }
    /// Takes a triangle whose leaf is at hand, so its corners need no search.
    template <class Leaf>
    Visit take(const Found& found, const Leaf& leaf, unsigned slot) {
        if (on_triangle == nullptr && !visit.takes_corners()) return take(found);
        if (!comes_here(found)) return Visit::next;
        return keep_place(found, take_triangle(found, leaf, slot));
    }

private:
    [[nodiscard]] bool comes_here(const Found& found) const {
        return is_first == nullptr || found.reference == found.index || is_first(blob, found.reference, reached);
    }
    Visit keep_place(const Found& found, Visit next) {
        if (next == Visit::stop) first = found.reference;  // where the next page begins
        return next;
    }
    /// Has a frame of its own: queries need no room for the corners.
    template <class Leaf>
    ESPALIER_NOINLINE Visit take_triangle(const Found& found, const Leaf& leaf, unsigned slot) {
        const LatticeTriangle triangle = leaf.triangle(slot);
        if (on_triangle != nullptr) return on_triangle(*this, found.index, triangle);
        return visit(TriangleId{found.index}, blob, found.reference, &triangle);
    }
};

/// The one that comes first: the nearest, of equally near ones the lowest index.
template <class Kind>
struct Closest : Answer {
    Kind& best;
    const TriangleFilter& filter;

    explicit Closest(Kind& place, const TriangleFilter& keep = no_filter)
        : Answer([](Answer& self, const Found& found) {
              return static_cast<Closest&>(self).take(static_cast<const Kind&>(found));
          }),
          best(place),
          filter(keep) {}
    [[nodiscard]] bool found() const { return last != no_index; }
    Visit take(const Kind& candidate) {
        if (found() && !comes_before(candidate, best)) return Visit::next;
        if (filter && !filter(TriangleId{candidate.index})) return Visit::next;
        best = candidate;
        worst = candidate.key();
        last = candidate.index;
        limit = candidate.limit(limit);
        return Visit::next;
    }
};

/// The few nearest.
struct NearestFew : Answer {
    const BlobData& blob;
    ClosestFew& few;

    NearestFew(const BlobData& from, ClosestFew& places) : Answer(take_found), blob(from), few(places) {}

private:
    static Visit take_found(Answer& self, const Found& found);
};

/// Bounds on a squared distance in lattice steps, as floats within 2^-18; infinite if there is no surface.
struct SquaredBounds {
    float lower = infinity;
    float upper = infinity;
};

/// The least distance of any triangle or small box, and the least of which one can say that something is as near. Both
/// are the same in whatever order they are found: what has one of them is never farther than any upper bound.
struct Bounds : Answer {
    SquaredBounds squared;

    Bounds()
        : Answer(
              [](Answer& self, const Found& found) {
                  const float distance = static_cast<const FoundNearest&>(found).key();
                  static_cast<Bounds&>(self).add(distance, distance);
                  return Visit::next;
              },
              [](Answer& self, float lower, float upper) { static_cast<Bounds&>(self).add(lower, upper); }) {}

private:
    void add(float lower, float upper) {
        squared.lower = minimum(lower, squared.lower);
        squared.upper = minimum(upper, squared.upper);
        lower_limit(upper);
    }
};

}  // namespace espalier::detail
