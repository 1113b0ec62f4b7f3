// The least for a core without floats: the blob opened as part of the image, and the first hit of a segment in whole
// lattice steps. No float operation is linked.
#include <espalier/blob.hpp>
#include <espalier/lattice.hpp>

#include "blob_in_image.hpp"

int main() {
    espalier::Blob blob;
    espalier::HitInSteps hit;
    if (open_trusted_image(espalier::firmware::blob_in_image(), blob) != espalier::Status::ok) return 2;
    return first_hit(blob, {{8, 8, 5000}, {8, 8, -5000}}, hit) == espalier::QueryStatus::ok ? 0 : 3;
}
