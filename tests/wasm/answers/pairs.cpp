// Queries of two blobs.
#include "questions.hpp"
#include "words.hpp"

#include <espalier/pair.hpp>

void answer_pairs(const espalier::Blob& a, const espalier::Blob& b, const Questions& questions) {
    const espalier::PlacedBlob placed_a(a, {{1.0f, 2.0f, 3.0f, 4.0f}, {0.25f, 0.0f, -0.5f}, 1.25f});
    constexpr auto all = espalier::WorkLimit::unlimited();
    constexpr espalier::WorkLimit few(40);
    Words touching("pair_overlaps");
    Words within("pair_within");
    Words first("pair_first_contact");
    Words apart("pair_distance");
    Words contacts("pair_contacts");
    Words some_contacts("pair_contacts_limited");
    Words touches("pair_touches");
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        const espalier::PlacedBlob placed_b(b, questions.place(i));
        touching.add(espalier::overlaps(placed_a, placed_b, all).status(),
                     espalier::overlaps(placed_a, placed_b, few).status());
        within.add(espalier::within_distance(placed_a, placed_b, questions.limits[i], all).status());
        const espalier::PairContact pair = espalier::first_contact(placed_a, placed_b, all);
        first.add(pair.a, pair.b, pair.status);
        const espalier::BlobDistance distance = espalier::distance(placed_a, placed_b, all, 1.5f);
        apart.add(distance.distance, distance.on_a, distance.on_b, distance.a, distance.b, distance.status);
        const auto add_contact = [](Words& words) {
            return [&words](const espalier::PairContact& each) { words.add(each.a, each.b, each.status); };
        };
        contacts.add(espalier::for_each_contact(placed_a, placed_b, add_contact(contacts), all));
        some_contacts.add(espalier::for_each_contact(placed_a, placed_b, add_contact(some_contacts), few));
        touches.add(espalier::for_each_touch(
            placed_a, placed_b,
            [&](const espalier::PairTouch& touch) {
                for (const espalier::Vec3& point : touch.points) touches.add(point);
                touches.add(touch.normal, touch.depth, touch.a, touch.b, touch.count, touch.status);
            },
            all));
    }
}
