// The outer form of a glTF file: JSON text (.gltf), or JSON and a chunk of bytes (.glb).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace espalier::importer {

struct GltfContainer {
    std::string format;  ///< "glTF 2.0", "glTF 2.0 binary" or "glTF 2.0 in b3dm"
    std::shared_ptr<const nlohmann::json> json;
    std::vector<std::byte> file;        ///< what `binary` points into; empty for .gltf
    std::span<const std::byte> binary;  ///< the binary chunk of a .glb
    std::size_t trailing_bytes = 0;     ///< behind the last chunk of a .glb, or the length that its header states
};

/// Reads a file. Returns nothing for what is no glTF by its content, unless it is `named_so`. Throws ImportError:
/// (file_access) when it cannot be read, (invalid_input) for a broken file, (unsupported) for another version than 2.0.
std::optional<GltfContainer> read_gltf_container(const std::string& path, bool named_so);

}  // namespace espalier::importer
