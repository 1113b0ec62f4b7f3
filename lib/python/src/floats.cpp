#include "floats.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

namespace espalier::python {

std::vector<py::ssize_t> shape_of(const py::array& array) { return {array.shape(), array.shape() + array.ndim()}; }

namespace {

std::string text_of(const std::vector<py::ssize_t>& shape, bool is_element) {
    std::string text = is_element ? "(..." : "(";
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
        if (axis > 0 || is_element) text += ", ";
        text += shape[axis] == any ? std::string("n") : std::to_string(shape[axis]);
    }
    return text + ")";
}

/// Returns the number of queries. Throws std::bad_alloc where no memory can hold their results.
std::size_t count_of(const std::vector<py::ssize_t>& shape) {
    if (std::find(shape.begin(), shape.end(), 0) != shape.end()) return 0;
    py::ssize_t count = 1;
    for (const py::ssize_t length : shape)
        if (__builtin_mul_overflow(count, length, &count)) throw std::bad_alloc();
    return static_cast<std::size_t>(count);
}

/// Whether it is a shape of this package or of a class that derives from one: a tuple of arrays.
bool is_shape(py::handle given) {
    if (!PyTuple_Check(given.ptr()) || PyTuple_CheckExact(given.ptr())) return false;
    for (const py::handle type : py::type::handle_of(given).attr("__mro__"))
        if (py::str(type.attr("__module__")).equal(py::str("espalier.shapes"))) return true;
    return false;
}

/// numpy would take a shape as rows of one array, and lists of shapes too, however deep.
void refuse_shapes(py::handle given, const char* name) {
    constexpr int deepest = 64;  // numpy's arrays have fewer axes, and a list may hold itself
    py::object first = py::reinterpret_borrow<py::object>(given);
    for (int depth = 0; depth < deepest && (PyList_Check(first.ptr()) || PyTuple_CheckExact(first.ptr())) &&
                        PySequence_Fast_GET_SIZE(first.ptr()) > 0;
         ++depth)
        first = py::reinterpret_borrow<py::object>(PySequence_Fast_GET_ITEM(first.ptr(), 0));
    if (!is_shape(first)) return;
    throw py::type_error(std::string(name) + " must be an array of numbers, not a " +
                         py::str(py::type::handle_of(first).attr("__name__")).cast<std::string>());
}

py::array array_of(py::handle given, const char* name) {
    refuse_shapes(given, name);
    const py::array array = py::array::ensure(given);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + " is no array of numbers");
    }
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u')
        throw py::type_error(std::string(name) + " has no real numbers but values of type " +
                             py::str(array.dtype()).cast<std::string>());
    return array;
}

/// Returns the numbers as float32 in the machine's byte order, without a copy where they are.
py::array as_float32(const py::array& array) {
    const py::dtype float32 = py::dtype::of<float>();
    if (array.dtype().is(float32)) return array;
    return array.attr("astype")(float32, py::arg("copy") = false);
}

/// Returns places, planes, or transforms, as they are seen from an origin, in float64.
py::array seen_from(const Vec3d& origin, const py::array& places) {
    py::array moved = places.attr("astype")(py::dtype::of<double>(), py::arg("order") = "C");
    constexpr py::ssize_t plane = 4, transform = 8;
    const py::ssize_t last = moved.shape(moved.ndim() - 1), width = last == plane || last == transform ? last : 3;
    auto* const first = static_cast<double*>(moved.mutable_data());
    for (double* row = first; row != first + moved.size(); row += width) {
        if (width == plane) {
            row[3] -= row[0] * origin.x + row[1] * origin.y + row[2] * origin.z;
        } else {
            double* const place = width == transform ? row + 4 : row;
            place[0] -= origin.x;
            place[1] -= origin.y;
            place[2] -= origin.z;
        }
    }
    return moved;
}

}  // namespace

Floats::Floats(py::handle given, const char* name, ElementShape element, const Origin& origin)
    : array_(array_of(given, name)), name_(name), element_(element) {
    std::vector<py::ssize_t> all = shape_of(array_);
    const std::size_t axes = element_.size();
    bool fits = all.size() >= axes;
    for (std::size_t axis = 0; fits && axis < axes; ++axis) {
        const py::ssize_t length = all[all.size() - axes + axis];
        fits = element_[axis] == any || element_[axis] == length;
    }
    if (!fits)
        throw py::value_error(std::string(name) + " must have the shape " + text_of(element_, true) + ", not " +
                              text_of(all, false));
    for (std::size_t axis = 0; axis < axes; ++axis) element_[axis] = all[all.size() - axes + axis];
    shape_.assign(all.begin(), all.end() - static_cast<std::ptrdiff_t>(axes));
    array_ = as_float32(origin ? seen_from(*origin, array_) : array_);

    // An element must lie in one piece.
    py::ssize_t expected = sizeof(float);
    bool contiguous = true;
    for (std::size_t axis = all.size(); axis > shape_.size(); --axis) {
        const py::ssize_t length = all[axis - 1];
        if (length > 1 && array_.strides(static_cast<py::ssize_t>(axis - 1)) != expected) contiguous = false;
        expected *= length;
    }
    element_bytes_ = static_cast<std::size_t>(expected);
    if (!contiguous) array_ = py::array_t<float, py::array::c_style | py::array::forcecast>(array_);
}

void Floats::spread(const std::vector<py::ssize_t>& shape) {
    std::vector<py::ssize_t> strides(shape.size(), 0);
    const std::size_t missing = shape.size() - shape_.size();
    for (std::size_t axis = 0; axis < shape_.size(); ++axis)
        if (shape_[axis] != 1) strides[missing + axis] = array_.strides(static_cast<py::ssize_t>(axis));
    first_ = static_cast<const char*>(array_.data());
    stride_ = 0;
    // One stride describes all axes where each outer one goes on where the inner one ends.
    bool found = false;
    py::ssize_t inner = 1;
    for (std::size_t axis = shape.size(); axis > 0; --axis) {
        if (shape[axis - 1] == 1) continue;
        if (!found) {
            stride_ = strides[axis - 1];
            found = true;
        } else if (py::ssize_t next = 0; __builtin_mul_overflow(stride_, inner, &next) || strides[axis - 1] != next) {
            copy_to_shape(shape, strides);
            return;
        }
        inner *= shape[axis - 1];
    }
}

void Floats::copy_to_shape(const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& strides) {
    const std::size_t count = count_of(shape);
    std::size_t bytes = 0;
    if (__builtin_mul_overflow(count, element_bytes_, &bytes)) throw std::bad_alloc();
    copy_.resize(bytes);
    std::vector<py::ssize_t> place(shape.size(), 0);
    const char* from = first_;
    for (std::size_t query = 0; query < count; ++query) {
        std::memcpy(copy_.data() + query * element_bytes_, from, element_bytes_);
        for (std::size_t axis = shape.size(); axis > 0; --axis) {
            from += strides[axis - 1];
            if (++place[axis - 1] < shape[axis - 1]) break;
            from -= strides[axis - 1] * shape[axis - 1];
            place[axis - 1] = 0;
        }
    }
    first_ = copy_.data();
    stride_ = static_cast<std::ptrdiff_t>(element_bytes_);
}

Batch::Batch(std::span<Floats* const> arguments) {
    for (const Floats* argument : arguments)
        if (argument->shape().size() > shape_.size())
            shape_.insert(shape_.begin(), argument->shape().size() - shape_.size(), 1);
    for (const Floats* argument : arguments) {
        const std::size_t missing = shape_.size() - argument->shape().size();
        for (std::size_t axis = 0; axis < argument->shape().size(); ++axis) {
            const py::ssize_t length = argument->shape()[axis];
            py::ssize_t& common = shape_[missing + axis];
            if (common == 1) common = length;
            if (length != 1 && length != common) {
                std::string text = "the arguments do not broadcast:";
                for (const Floats* each : arguments)
                    text += std::string(" ") + each->name() + " has queries of shape " + text_of(each->shape(), false) +
                            (each == arguments.back() ? "" : ",");
                throw py::value_error(text);
            }
        }
    }
    count_ = count_of(shape_);
    for (Floats* argument : arguments) argument->spread(shape_);
}

}  // namespace espalier::python
