// Open blobs and scenes with the bytes that they look at.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <pybind11/pybind11.h>

#include <espalier/blob.hpp>
#include <espalier/c/bake.h>
#include <espalier/scene.hpp>

namespace espalier::python {

namespace py = pybind11;

/// Bytes that stay where they are and unchanged while this lives.
class HeldBytes {
public:
    /// Holds an object of Python: one that is read-only as it is, one that is writable by a copy. Throws BufferError
    /// where it has no contiguous bytes.
    static std::shared_ptr<const HeldBytes> of(py::handle object);
    /// Takes bytes over.
    static std::shared_ptr<const HeldBytes> of(std::vector<std::byte> bytes);
    /// Takes the result of a bake over.
    static std::shared_ptr<const HeldBytes> of(const espalier_bake_result* result);

    HeldBytes(const HeldBytes&) = delete;
    HeldBytes& operator=(const HeldBytes&) = delete;
    ~HeldBytes();

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
    /// Returns whether these are the bytes of the object itself and no copy.
    [[nodiscard]] bool is_view() const { return view_.obj != nullptr; }

private:
    HeldBytes() = default;

    std::span<const std::byte> bytes_;
    std::vector<std::byte> copy_;
    Py_buffer view_ = {};
    const espalier_bake_result* result_ = nullptr;
};

/// A blob as Python holds it. One of a scene holds the bytes of the whole scene.
struct HeldBlob {
    std::shared_ptr<const HeldBytes> held;
    Blob blob;

    /// Returns the bytes of the blob alone.
    [[nodiscard]] std::span<const std::byte> bytes() const { return {detail::data_of(blob).bytes, blob.size()}; }
};

/// A scene as Python holds it.
struct HeldScene {
    std::shared_ptr<const HeldBytes> held;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    BakedScene scene;
};

}  // namespace espalier::python
