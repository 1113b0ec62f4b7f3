// Keys of JSON objects: where two are equal, readers differ in which one counts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace espalier::tools {

/// A key that an object has twice, and the object: "meshes[0].primitives[1]", or empty for the outermost one.
struct RepeatedKey {
    std::string key;
    std::string object;
};

/// Returns the first repeated key of a JSON text, and nothing for one without, or for broken JSON.
std::optional<RepeatedKey> repeated_key(std::string_view json);

}  // namespace espalier::tools
