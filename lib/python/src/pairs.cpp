// Two blobs, each at many places.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "floats.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "parts.hpp"

#include <espalier/pair.hpp>

namespace espalier::python {

namespace {

/// The places of two blobs.
struct Places {
    Floats a;
    Floats b;
    Floats distances;
    Batch batch;
    Strided<Transform> place_a;
    Strided<Transform> place_b;
    Strided<float> distance;

    Places(const py::handle& given_a, const py::handle& given_b, const py::handle& given_distance)
        : a(given_a, "place_a", {8}),
          b(given_b, "place_b", {8}),
          distances(given_distance, "distance", {}),
          batch({&a, &b, &distances}),
          place_a(a.as<Transform>()),
          place_b(b.as<Transform>()),
          distance(distances.as<float>()) {}
};

/// Answers a query of two placed blobs for each pair of places.
template <class Result, class Query>
py::array answers(const HeldBlob& a, const HeldBlob& b, const Places& places, const py::dtype& type, unsigned threads,
                  const Query& query) {
    py::array results = places.batch.results(type);
    answer_each(static_cast<Result*>(results.mutable_data()), places.batch.count(), threads, [&](std::size_t i) {
        return query(PlacedBlob(a.blob, places.place_a.at(i)), PlacedBlob(b.blob, places.place_b.at(i)), i);
    });
    return results;
}

py::array pairs_touch(const HeldBlob& a, const HeldBlob& b, const py::handle& place_a, const py::handle& place_b,
                      std::uint64_t limit, unsigned threads) {
    const Places places(place_a, place_b, py::float_(0.0));
    return answers<YesNo>(a, b, places, py::dtype::of<std::uint8_t>(), threads,
                          [&](const PlacedBlob& first, const PlacedBlob& second, std::size_t) {
                              return overlaps(first, second, WorkLimit(limit));
                          });
}

py::array pairs_first_contact(const HeldBlob& a, const HeldBlob& b, const py::handle& place_a,
                              const py::handle& place_b, std::uint64_t limit, unsigned threads) {
    const Places places(place_a, place_b, py::float_(0.0));
    return answers<PairContact>(a, b, places, dtype_of("pair_contact"), threads,
                                [&](const PlacedBlob& first, const PlacedBlob& second, std::size_t) {
                                    return first_contact(first, second, WorkLimit(limit));
                                });
}

py::array pairs_distance(const HeldBlob& a, const HeldBlob& b, const py::handle& place_a, const py::handle& place_b,
                         const py::handle& max_distance, std::uint64_t limit, unsigned threads) {
    const Places places(place_a, place_b, max_distance);
    return answers<BlobDistance>(a, b, places, dtype_of("blob_distance"), threads,
                                 [&](const PlacedBlob& first, const PlacedBlob& second, std::size_t i) {
                                     return distance(first, second, WorkLimit(limit), places.distance.at(i));
                                 });
}

py::array pairs_within(const HeldBlob& a, const HeldBlob& b, const py::handle& place_a, const py::handle& place_b,
                       const py::handle& within, std::uint64_t limit, unsigned threads) {
    const Places places(place_a, place_b, within);
    return answers<YesNo>(a, b, places, py::dtype::of<std::uint8_t>(), threads,
                          [&](const PlacedBlob& first, const PlacedBlob& second, std::size_t i) {
                              return within_distance(first, second, places.distance.at(i), WorkLimit(limit));
                          });
}

/// Returns (offsets, values, statuses) of what a function of the library visits. The limit counts for each pair of
/// places as a whole.
template <class Value, class ForEach>
py::tuple lists(const HeldBlob& a, const HeldBlob& b, const Places& places, const py::dtype& type, std::uint64_t limit,
                unsigned threads, const ForEach& for_each) {
    return make_lists<Value>(places.batch, type, threads, [&](std::size_t i, Growing<Value>& values) {
        return append(values, [&](const auto& push) {
            return for_each(PlacedBlob(a.blob, places.place_a.at(i)), PlacedBlob(b.blob, places.place_b.at(i)), push,
                            WorkLimit(limit));
        });
    });
}

py::tuple pairs_contact_lists(const HeldBlob& a, const HeldBlob& b, const py::handle& place_a,
                              const py::handle& place_b, std::uint64_t limit, unsigned threads) {
    return lists<PairContact>(a, b, Places(place_a, place_b, py::float_(0.0)), dtype_of("pair_contact"), limit, threads,
                              for_each_contact);
}

py::tuple pairs_touch_lists(const HeldBlob& a, const HeldBlob& b, const py::handle& place_a, const py::handle& place_b,
                            std::uint64_t limit, unsigned threads) {
    return lists<PairTouch>(a, b, Places(place_a, place_b, py::float_(0.0)), dtype_of("pair_touch"), limit, threads,
                            for_each_touch);
}

}  // namespace

void bind_pairs(py::module_& module) {
    module.def("pairs_touch", pairs_touch);
    module.def("pairs_first_contact", pairs_first_contact);
    module.def("pairs_distance", pairs_distance);
    module.def("pairs_within", pairs_within);
    module.def("pairs_contact_lists", pairs_contact_lists);
    module.def("pairs_touch_lists", pairs_touch_lists);
}

}  // namespace espalier::python
