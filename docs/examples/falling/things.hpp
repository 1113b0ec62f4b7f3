// The meshes of the things that fall: made here, baked once.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/espalier.hpp>

namespace falling {

/// A crate, a barrel and a wedge, each about a metre across, as open blobs.
class Things {
public:
    /// Throws std::runtime_error if a mesh is refused.
    Things();
    Things(const Things&) = delete;
    Things& operator=(const Things&) = delete;
    ~Things() = default;

    [[nodiscard]] const std::vector<espalier::Blob>& meshes() const { return meshes_; }

private:
    std::vector<std::vector<std::byte>> bytes_;
    std::vector<espalier::Blob> meshes_;
};

}  // namespace falling
