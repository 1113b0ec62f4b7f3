// Asks about two blobs, or about one against itself.
#pragma once

#include <cstddef>
#include <cstdint>

#include "answer_counts.hpp"
#include "questions.hpp"

namespace espalier::platform {

/// The index, or 0 for no triangle.
inline std::uint32_t index_word(TriangleId triangle) { return triangle == no_triangle ? 0 : triangle.index; }

/// A list that is refused, in the words of the golden hashes: they are older than lists of duplicate references.
inline constexpr std::uint32_t list_refused = 4;

/// Mostly with so little work that small cores come to an end: where that is, is an answer too.
inline void ask_pairs(const Blob& a, const Blob& b, Questions& questions_to_a, std::uint32_t number, Answers& answers) {
    Fingerprint& fingerprint = answers.fingerprint;
    const bool has_duplicates = a.duplicate_reference_count() != 0 || b.duplicate_reference_count() != 0;
    const Transform placement = questions_to_a.placement(number, b);
    const PlacedBlob placed_b(b, placement);
    const WorkLimit limit(number % 16 == 9 ? 2000u : 60u);
    PairContact pairs[8];
    const Filled filled = collect_contacts(a, placed_b, pairs, limit);
    if (has_duplicates) {
        fingerprint.add(list_refused);
    } else {
        fingerprint.add(filled.status);
    }
    fingerprint.add(has_duplicates ? 0 : static_cast<std::uint32_t>(filled.count));
    for (const PairContact& pair : filled.in(pairs)) {
        if (has_duplicates) break;
        fingerprint.add(pair.a.index);
        fingerprint.add(pair.b.index);
    }
    const YesNo touch = overlaps(a, placed_b, limit);
    fingerprint.add(touch.status(), touch.yes());
    const PairContact first = first_contact(a, placed_b, limit);
    fingerprint.add(first.status, bool(first));
    fingerprint.add(index_word(first.a));
    fingerprint.add(index_word(first.b));
    const PairTouch place = pair_touch(a, placed_b, first);
    fingerprint.add(place.status, std::uint32_t{place.count});
    for (unsigned i = 0; i < place.count; ++i) fingerprint.add(place.points[i]);
    fingerprint.add(place.normal);
    fingerprint.add(place.depth);
    const BlobDistance nearest = distance(a, placed_b, limit, questions_to_a.distance(number));
    const bool is_near = nearest.a != no_triangle;
    fingerprint.add(nearest.status, is_near, is_near ? nearest.distance : 0.0f, nearest.on_a, nearest.on_b);
    fingerprint.add(index_word(nearest.a));
    fingerprint.add(index_word(nearest.b));
    const YesNo within = within_distance(a, placed_b, questions_to_a.distance(1), limit);
    fingerprint.add(within.status(), within.yes());
    answers.calls += 6;
    answers.pairs_near += is_near || touch.yes() ? 1u : 0u;
}

}  // namespace espalier::platform
