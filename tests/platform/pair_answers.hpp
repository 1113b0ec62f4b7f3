// Asks about two blobs, or about one against itself.
#pragma once

#include <cstddef>
#include <cstdint>

#include "answer_counts.hpp"
#include "questions.hpp"

namespace espalier::platform {

/// Mostly with so little work that small cores come to an end: where that is, is an answer too.
inline void ask_pairs(const Blob& a, const Blob& b, Questions& questions_to_a, std::uint32_t count, Answers& answers) {
    Fingerprint& fingerprint = answers.fingerprint;
    for (std::uint32_t number = 0; number < count; ++number) {
        const Placement placement = questions_to_a.placement(number, b);
        const WorkLimit limit = {number % 16 == 9 ? 2000u : 60u};
        TrianglePair pairs[8];
        std::size_t found = 0;
        fingerprint.add(static_cast<std::uint32_t>(all_contacts(a, b, placement, pairs, found, limit)));
        fingerprint.add(static_cast<std::uint32_t>(found));
        for (std::size_t i = 0; i < found; ++i) {
            fingerprint.add(pairs[i].a.index);
            fingerprint.add(pairs[i].b.index);
        }
        bool touch = false;
        fingerprint.add(static_cast<std::uint32_t>(collides(a, b, placement, touch, limit)));
        fingerprint.add(touch);
        TrianglePair first;
        bool is_first = false;
        fingerprint.add(static_cast<std::uint32_t>(first_contact(a, b, placement, first, is_first, limit)));
        fingerprint.add(is_first);
        fingerprint.add(first.a.index);
        fingerprint.add(first.b.index);
        bool is_near = false;
        PairDistance nearest;
        const float max_distance = questions_to_a.distance(number);
        fingerprint.add(
            static_cast<std::uint32_t>(minimum_distance(a, b, placement, max_distance, nearest, is_near, limit)));
        fingerprint.add(is_near);
        fingerprint.add(nearest.distance);
        fingerprint.add(nearest.on_a);
        fingerprint.add(nearest.on_b);
        fingerprint.add(nearest.pair.a.index);
        fingerprint.add(nearest.pair.b.index);
        bool is_within = false;
        fingerprint.add(
            static_cast<std::uint32_t>(within_distance(a, b, placement, questions_to_a.distance(1), is_within, limit)));
        fingerprint.add(is_within);
        answers.calls += 5;
        answers.pairs_near += is_near || touch ? 1u : 0u;
    }
}

}  // namespace espalier::platform
