// Approximate queries against the loop over all triangles: nothing is missed, and a wrong yes is near.
#pragma once

#include "support/testing.hpp"

#include <runtime/traversal/small_boxes.hpp>

#include "support/loops/triangle_loop.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests {

struct Tally {
    std::uint64_t yes = 0, wrong_yes = 0, no = 0;
    void add(bool maybe, bool exact) { ++(!maybe ? no : exact ? yes : wrong_yes); }
    void check() const {
        if (!asks_enough()) return;
        CHECK(yes > 0);
        CHECK(wrong_yes > 0);
        CHECK(no > 0);
    }
};

/// What is asked, and what answers without a tree.
struct Asked {
    Asked(const Blob& asked, const DecodedBlob& triangles, std::uint64_t seed)
        : blob(asked),
          decoded(triangles),
          extent(decoded.extent),
          loop(decoded),
          maker(decoded, seed),
          queries(decoded, seed) {}

    const Blob& blob;
    DecodedBlob decoded;  ///< which the makers refer to
    std::array<std::uint32_t, 3> extent;
    TriangleLoop loop;
    ShapeMaker maker;
    QueryMaker queries;

    [[nodiscard]] double steps(float accuracy) const {
        return std::max(0, detail::steps_in(detail::data_of(blob), accuracy));
    }
};

/// Asks for one query, exactly and approximately. An awkward one touches, lies in a plane or has no size.
using Check = void (*)(Asked& asked, bool awkward, Tally& tally);
void check_sphere(Asked& asked, bool awkward, Tally& tally);
void check_box(Asked& asked, bool awkward, Tally& tally);
void check_ray(Asked& asked, bool awkward, Tally& tally);
void check_bounds(Asked& asked, bool awkward, Tally& tally);
/// Compares the answers and the work of every instruction set.
void check_instruction_sets(Asked& asked, bool awkward, Tally& tally);

}  // namespace espalier::tests
