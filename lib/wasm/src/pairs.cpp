// Pairs of blobs, each blob at one place for each query: one call of the functions of C for each.
#include <cstddef>
#include <cstdint>

#include <espalier/c/batches/arrays.h>
#include <espalier/c/blob.h>
#include <espalier/c/pair.h>
#include <espalier/c/transform.h>

#include "lists.hpp"

namespace {

/// Two blobs, with an array of places for each.
struct Pairs {
    const espalier_blob* blob_a;
    const espalier_blob* blob_b;
    const espalier_transform* places_a;
    const espalier_transform* places_b;

    [[nodiscard]] espalier_placed_blob a(std::size_t i) const { return {blob_a, places_a[i]}; }
    [[nodiscard]] espalier_placed_blob b(std::size_t i) const { return {blob_b, places_b[i]}; }
};

/// Calls query(a, b, i) for the places of each pair.
template <class Result, class Query>
void answer_each(const Pairs& pairs, Result* results, std::size_t count, const Query& query) {
    for (std::size_t i = 0; i < count; ++i) {
        const espalier_placed_blob a = pairs.a(i);
        const espalier_placed_blob b = pairs.b(i);
        results[i] = query(&a, &b, i);
    }
}

/// Writes the elements that for_each visits of each pair. The limit is that of one pair.
template <class Item, class ForEach>
espalier_filled_lists collect(const Pairs& pairs, std::size_t count, const espalier::wasm::ListArrays<Item>& to,
                              std::uint64_t limit, const ForEach& for_each) {
    return espalier::wasm::collect_lists<Item>(count, to, [&](std::size_t i, auto& room) {
        const espalier_placed_blob a = pairs.a(i);
        const espalier_placed_blob b = pairs.b(i);
        return for_each(&a, &b, espalier::wasm::add_to_room<Item>, &room, limit);
    });
}

}  // namespace

// Each function begins with where it writes, as C's own that return a structure.

extern "C" [[clang::export_name("wasm_pair_overlaps")]] void wasm_pair_overlaps(
    espalier_yes_no* answers, const espalier_blob* blob_a, const espalier_blob* blob_b,
    const espalier_transform* places_a, const espalier_transform* places_b, std::size_t count, std::uint64_t limit) {
    answer_each({blob_a, blob_b, places_a, places_b}, answers, count,
                [&](const auto* a, const auto* b, std::size_t) { return espalier_overlaps_blob(a, b, limit); });
}

extern "C" [[clang::export_name("wasm_pair_within_distance")]] void wasm_pair_within_distance(
    espalier_yes_no* answers, const espalier_blob* blob_a, const espalier_blob* blob_b,
    const espalier_transform* places_a, const espalier_transform* places_b, std::size_t count, std::uint64_t limit,
    const float* distances) {
    answer_each({blob_a, blob_b, places_a, places_b}, answers, count, [&](const auto* a, const auto* b, std::size_t i) {
        return espalier_within_distance(a, b, distances[i], limit);
    });
}

extern "C" [[clang::export_name("wasm_pair_first_contact")]] void wasm_pair_first_contact(
    espalier_pair_contact* contacts, const espalier_blob* blob_a, const espalier_blob* blob_b,
    const espalier_transform* places_a, const espalier_transform* places_b, std::size_t count, std::uint64_t limit) {
    answer_each({blob_a, blob_b, places_a, places_b}, contacts, count,
                [&](const auto* a, const auto* b, std::size_t) { return espalier_first_contact(a, b, limit); });
}

extern "C" [[clang::export_name("wasm_pair_distance")]] void wasm_pair_distance(
    espalier_blob_distance* distances, const espalier_blob* blob_a, const espalier_blob* blob_b,
    const espalier_transform* places_a, const espalier_transform* places_b, std::size_t count, std::uint64_t limit,
    const float* max_distances) {
    answer_each(
        {blob_a, blob_b, places_a, places_b}, distances, count,
        [&](const auto* a, const auto* b, std::size_t i) { return espalier_distance(a, b, limit, max_distances[i]); });
}

extern "C" [[clang::export_name("wasm_pair_contacts")]] void wasm_pair_contacts(
    espalier_filled_lists* filled, const espalier_blob* blob_a, const espalier_blob* blob_b,
    const espalier_transform* places_a, const espalier_transform* places_b, espalier_query_status* statuses,
    std::size_t* offsets, std::size_t count, espalier_pair_contact* contacts, std::size_t capacity,
    std::uint64_t limit) {
    *filled = collect<espalier_pair_contact>({blob_a, blob_b, places_a, places_b}, count,
                                             {statuses, offsets, contacts, capacity}, limit, espalier_for_each_contact);
}

extern "C" [[clang::export_name("wasm_pair_touches")]] void wasm_pair_touches(
    espalier_filled_lists* filled, const espalier_blob* blob_a, const espalier_blob* blob_b,
    const espalier_transform* places_a, const espalier_transform* places_b, espalier_query_status* statuses,
    std::size_t* offsets, std::size_t count, espalier_pair_touch* touches, std::size_t capacity, std::uint64_t limit) {
    *filled = collect<espalier_pair_touch>({blob_a, blob_b, places_a, places_b}, count,
                                           {statuses, offsets, touches, capacity}, limit, espalier_for_each_touch);
}
