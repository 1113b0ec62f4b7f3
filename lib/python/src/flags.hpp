// Filters: an array of flags that the library reads as a callable.
#pragma once

#include <cstddef>
#include <cstdint>

#include <pybind11/numpy.h>

#include <espalier/base/function_ref.hpp>
#include <espalier/scene.hpp>
#include <espalier/types.hpp>

namespace espalier::python {

namespace py = pybind11;

/// The flags of a filter, by number of a triangle or an instance: a query keeps those that are not 0. None keep all.
/// Filters that it returns refer to it.
class Flags {
public:
    /// Holds an array of uint8, or nothing for None.
    explicit Flags(const py::object& given) : is_given_(!given.is_none()) {
        if (!is_given_) return;
        array_ = Array(given);
        first_ = array_.data();
        count_ = static_cast<std::size_t>(array_.size());
    }
    Flags(const Flags&) = delete;
    Flags& operator=(const Flags&) = delete;

    bool operator()(TriangleId triangle) const { return keeps(triangle.index); }
    bool operator()(InstanceId instance, TriangleId) const { return keeps(instance.index); }

    /// Returns the filter of a query of one blob.
    [[nodiscard]] TriangleFilter of_triangles() const { return is_given_ ? TriangleFilter(*this) : TriangleFilter(); }
    /// Returns the filter of a query of a scene.
    [[nodiscard]] SceneFilter of_instances(std::uint32_t mask) const {
        return is_given_ ? SceneFilter(mask, SceneTriangleFilter(*this)) : SceneFilter(mask);
    }

private:
    using Array = py::array_t<std::uint8_t, py::array::c_style>;

    [[nodiscard]] bool keeps(std::uint32_t number) const { return number < count_ && first_[number] != 0; }

    bool is_given_;
    Array array_;
    const std::uint8_t* first_ = nullptr;
    std::size_t count_ = 0;
};

}  // namespace espalier::python
