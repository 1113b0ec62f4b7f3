// The instances that Python gives to bake_scene() and to a moving scene.
#pragma once

#include <cstddef>
#include <cstdint>

#include <pybind11/numpy.h>

#include <espalier/scene.hpp>

#include "floats.hpp"

namespace espalier::python {

/// Instances: `places` has 8 numbers of each, `numbers` its mesh, mask and user.
struct GivenInstances {
    using Numbers = py::array_t<std::uint32_t, py::array::c_style>;

    Floats places;
    Batch batch;
    Numbers numbers;

    GivenInstances(const py::handle& given_places, Numbers given_numbers, const Origin& origin = {})
        : places(given_places, "places", {8}, origin), batch({&places}), numbers(std::move(given_numbers)) {
        if (numbers.ndim() != 2 || numbers.shape(1) != 3 || static_cast<std::size_t>(numbers.shape(0)) != batch.count())
            throw py::value_error("there must be a mesh, a mask and a user's number for each instance");
    }

    [[nodiscard]] Instance at(std::size_t i) const {
        const std::uint32_t* row = numbers.data() + 3 * i;
        return {places.as<Transform>().at(i), row[0], row[1], row[2], 0};
    }
};

}  // namespace espalier::python
