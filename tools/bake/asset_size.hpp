// How large an asset is before it is baked.
#pragma once

#include "import/base/imported.hpp"

namespace espalier::tools {

/// In units of the blob.
struct AssetSize {
    double extent = 0.0;       ///< the largest side of the bounds of all triangles with an area
    double uncertainty = 0.0;  ///< how far `extent` may be off, because corners were rounded to float32
};

/// Returns the size of all meshes, or of all places if they are kept.
AssetSize asset_size(const Imported& imported);

}  // namespace espalier::tools
