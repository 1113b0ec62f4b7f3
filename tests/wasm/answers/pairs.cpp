// Queries of two blobs.
#include "questions.hpp"
#include "words.hpp"

namespace espalier::answers {

void answer_pairs(const Blob& a, const Blob& b, const Questions& questions) {
    const PlacedBlob placed_a(a, {{1.0f, 2.0f, 3.0f, 4.0f}, {0.25f, 0.0f, -0.5f}, 1.25f});
    constexpr auto all = WorkLimit::unlimited();
    constexpr WorkLimit few(40);
    for (std::size_t i = 0; i < questions.count(); ++i) {
        const PlacedBlob placed_b(b, questions.place(i));
        words["pair_overlaps"].add(overlaps(placed_a, placed_b, all).status(),
                                   overlaps(placed_a, placed_b, few).status());
        words["pair_within"].add(within_distance(placed_a, placed_b, questions.limits[i], all).status());
        words["pair_first_contact"].add(first_contact(placed_a, placed_b, all));
        words["pair_distance"].add(distance(placed_a, placed_b, all, 1.5f));
        const auto add_to = [](Words& list) { return [&list](const auto& each) { list.add(each); }; };
        Words &contacts = words["pair_contacts"], &some = words["pair_contacts_limited"];
        contacts.add(for_each_contact(placed_a, placed_b, add_to(contacts), all));
        some.add(for_each_contact(placed_a, placed_b, add_to(some), few));
        Words& touches = words["pair_touches"];
        touches.add(for_each_touch(placed_a, placed_b, add_to(touches), all));
    }
}

}  // namespace espalier::answers
