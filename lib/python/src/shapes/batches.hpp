// Batches of queries that take a shape of a kind that Python names.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>

#include "floats.hpp"
#include "lists.hpp"
#include "parts.hpp"
#include "shapes/fields.hpp"

namespace espalier::python {

/// Returns answer(shape, query) for each shape of a batch, which `more` is spread with. Refuses the kinds of shapes
/// that `answer` does not take. Holds what lock() returns while it answers.
template <class Answer, class Lock = WithoutLock>
py::array answer_shapes(const GivenShapes& given, Floats* more, const py::dtype& type, unsigned threads,
                        const Answer& answer, const Lock& lock = {}) {
    ShapeFields fields(given.origin);
    return with_shape(given, fields, [&]<class Shape>(std::type_identity<Shape>, const auto& at) -> py::array {
        if constexpr (std::invocable<const Answer&, const Shape&, std::size_t>) {
            const Batch batch = spread(fields, more);
            py::array results = batch.results(type);
            using Result = std::invoke_result_t<const Answer&, const Shape&, std::size_t>;
            answer_each(
                static_cast<Result*>(results.mutable_data()), batch.count(), threads,
                [&](std::size_t i) { return at(i, [&](const Shape& shape) { return answer(shape, i); }); }, lock);
            return results;
        } else {
            refuse_shape(given.kind);
        }
    });
}

/// Returns (offsets, values, statuses), where list(shape, query, values) appends those of a shape and returns its
/// status. `more` is spread with the shapes. Refuses the kinds of shapes that `list` does not take. Holds what lock()
/// returns meanwhile.
template <class Value, class List, class Lock = WithoutLock>
py::tuple list_for_shapes(const GivenShapes& given, Floats* more, const py::dtype& type, unsigned threads,
                          const List& list, const Lock& lock = {}) {
    ShapeFields fields(given.origin);
    return with_shape(given, fields, [&]<class Shape>(std::type_identity<Shape>, const auto& at) -> py::tuple {
        if constexpr (std::invocable<const List&, const Shape&, std::size_t, Growing<Value>&>) {
            const Batch batch = spread(fields, more);
            return make_lists<Value>(
                batch, type, threads,
                [&](std::size_t i, Growing<Value>& values) {
                    return at(i, [&](const Shape& shape) { return list(shape, i, values); });
                },
                lock);
        } else {
            refuse_shape(given.kind);
        }
    });
}

}  // namespace espalier::python
