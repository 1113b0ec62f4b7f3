// All that a core without floats may ask: run_firmware.sh looks at what this links.
#include <espalier/blob.hpp>
#include <espalier/advanced/lattice.hpp>

#include "blob_in_image.hpp"

using namespace espalier;

int main() {
    const Blob blob = open_unchecked(firmware::blob_in_image());
    if (!blob) return 2;
    const Lattice lattice = blob.lattice();
    const Result<LatticePoint> point = to_lattice(lattice, lattice.origin);
    const Result<LatticeBox> around = to_lattice(lattice, Box{lattice.origin, lattice.origin});
    if (!point || !around) return 3;
    const LatticeBox& box = *around;
    bool any = overlaps(blob, box).yes();
    TriangleId page[4];
    const Filled found = collect_overlaps(blob, box, page);
    const bool saw_all = for_each_overlap(blob, box, [](TriangleId) {}) == QueryStatus::ok;
    const LatticeSegment segment = {*point, {8, 8, 5000}};
    if (is_refused(raycast(blob, segment).status)) return 4;
    if (is_refused(occluded(blob, segment).status())) return 5;
    return any && saw_all && found.count != 0 ? 0 : 1;
}
