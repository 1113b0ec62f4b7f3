// Which extensions of glTF a file may require.
#pragma once

#include <import/gltf/data/json.hpp>

namespace espalier::importer {

/// Throws ImportError (unsupported), with the name and the way out, when the file requires an extension that is
/// neither read nor on the list of those that leave triangles alone.
void require_known_gltf_extensions(const GltfObject& root);

}  // namespace espalier::importer
