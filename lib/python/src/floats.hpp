// The float32 arguments of a batch: NumPy arrays of any type and strides, which broadcast against each other.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include <pybind11/numpy.h>

#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>
#include <espalier/types.hpp>

namespace espalier::python {

/// Where 0 0 0 of a blob lies in its source; none where the two have the same coordinates.
using Origin = std::optional<Vec3d>;

inline Origin origin_of(const Vec3d& origin) { return origin == Vec3d{} ? Origin() : Origin(origin); }
/// Returns the origin of a blob.
inline Origin origin_of(const Blob& blob) { return origin_of(blob.source_origin()); }

namespace py = pybind11;

/// Returns the lengths of the axes of an array.
std::vector<py::ssize_t> shape_of(const py::array& array);

/// The shape of one element of an argument: {} for a number, {3} for a vector. `any` is an axis of any length.
using ElementShape = std::initializer_list<py::ssize_t>;
inline constexpr py::ssize_t any = -1;

/// One argument. float32 stays where it lies if each element is contiguous; all else is converted to float32 once,
/// each number rounded to the nearest.
class Floats {
public:
    /// Throws ValueError, which names the argument, where its last axes are not those of an element, and TypeError
    /// where it has no real numbers. With an origin the elements are places, or planes of four numbers, in the
    /// coordinates of the source: it is subtracted in float64, before they are rounded. Of rows of eight numbers, it is
    /// subtracted from the translation.
    Floats(py::handle given, const char* name, ElementShape element, const Origin& origin = {});

    /// Returns the axes before those of an element.
    [[nodiscard]] const std::vector<py::ssize_t>& shape() const { return shape_; }
    [[nodiscard]] const char* name() const { return name_; }
    /// Returns the length of an axis of the elements.
    [[nodiscard]] py::ssize_t element_axis(std::size_t axis) const { return element_[axis]; }

    /// Gives each query its element: broadcasts to a shape, and copies only where one stride cannot describe that.
    void spread(const std::vector<py::ssize_t>& shape);
    /// Returns the elements after spread().
    template <class Value>
    [[nodiscard]] Strided<Value> as() const {
        return {first_, stride_};
    }
    /// Returns the address of a query's element after spread().
    [[nodiscard]] const char* at(std::size_t query) const {
        return first_ + static_cast<std::ptrdiff_t>(query) * stride_;
    }

private:
    void copy_to_shape(const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& strides);

    py::array array_;  // keeps the numbers
    const char* name_;
    std::vector<py::ssize_t> shape_;
    std::vector<py::ssize_t> element_;
    std::vector<char> copy_;
    std::size_t element_bytes_ = sizeof(float);
    const char* first_ = nullptr;
    std::ptrdiff_t stride_ = 0;
};

/// The common shape of the arguments of a batch.
class Batch {
public:
    /// Spreads all arguments. Throws ValueError where their shapes do not broadcast, and
    /// std::bad_alloc where no memory could hold the results.
    explicit Batch(std::span<Floats* const> arguments);
    Batch(std::initializer_list<Floats*> arguments) : Batch(std::span(arguments.begin(), arguments.size())) {}

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const std::vector<py::ssize_t>& shape() const { return shape_; }
    /// Returns an array for the results, one for each query, whose numbers are not set.
    [[nodiscard]] py::array results(const py::dtype& type) const { return py::array(type, shape_); }

private:
    std::vector<py::ssize_t> shape_;
    std::size_t count_ = 0;
};

}  // namespace espalier::python
