// The least for a core without floats: the blob opened as part of the image, and the first hit of a segment in whole
// lattice steps. No float operation is linked.
#include <espalier/blob.hpp>
#include <espalier/advanced/lattice.hpp>

#include "blob_in_image.hpp"

int main() {
    const espalier::Blob blob = espalier::open_unchecked(espalier::firmware::blob_in_image());
    if (!blob) return 2;
    const auto hit = raycast(blob, espalier::LatticeSegment{{8, 8, 5000}, {8, 8, -5000}});
    return is_refused(hit.status) ? 3 : 0;
}
