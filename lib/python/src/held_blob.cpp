#include "held_blob.hpp"

#include <utility>

namespace espalier::python {

std::shared_ptr<const HeldBytes> HeldBytes::of(py::handle object) {
    const std::shared_ptr<HeldBytes> held(new HeldBytes());
    if (PyObject_GetBuffer(object.ptr(), &held->view_, PyBUF_SIMPLE) != 0) {
        held->view_ = {};
        throw py::error_already_set();
    }
    const auto* first = static_cast<const std::byte*>(held->view_.buf);
    const auto size = static_cast<std::size_t>(held->view_.len);
    if (held->view_.readonly == 0) {
        held->copy_.assign(first, first + size);
        PyBuffer_Release(&held->view_);
        held->view_ = {};
        held->bytes_ = held->copy_;
    } else {
        held->bytes_ = {first, size};
    }
    return held;
}

std::shared_ptr<const HeldBytes> HeldBytes::of(std::vector<std::byte> bytes) {
    const std::shared_ptr<HeldBytes> held(new HeldBytes());
    held->copy_ = std::move(bytes);
    held->bytes_ = held->copy_;
    return held;
}

std::shared_ptr<const HeldBytes> HeldBytes::of(const espalier_bake_result* result) {
    const std::shared_ptr<HeldBytes> held(new HeldBytes());
    held->result_ = result;
    held->bytes_ = {static_cast<const std::byte*>(result->bytes), result->byte_count};
    return held;
}

HeldBytes::~HeldBytes() {
    espalier_release_bake_result(result_);
    if (view_.obj == nullptr) return;
    const py::gil_scoped_acquire locked;
    PyBuffer_Release(&view_);
}

}  // namespace espalier::python
