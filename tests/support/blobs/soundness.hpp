// Whether a blob keeps the rules that `open` does not check: those that no query's safety hangs on, but its answers do.
#pragma once

#include "support/format/decoder.hpp"

namespace espalier::tests {

/// No box ends farther beyond the extent than docs/format.md, 5.1, says.
bool boxes_end_near_asset(const DecodedBlob& decoded);

/// Every box on the way to a triangle holds it and ends near the asset, and every triangle has area, except those of a
/// deformable blob. False also of a blob with copies, whose boxes hold parts of triangles. On a sound blob every query
/// must equal the loop over all triangles; on others it must be safe.
bool is_sound(const DecodedBlob& decoded);
/// The same of bytes; false too when the decoder cannot make sense of them.
bool is_sound(std::span<const std::byte> blob);

}  // namespace espalier::tests
