// All that a core without floats may ask: run_firmware.sh looks at what this links.
#include <espalier/blob.hpp>
#include <espalier/lattice.hpp>

#include "blob_in_image.hpp"

using namespace espalier;

int main() {
    Blob blob;
    if (open_trusted_image(firmware::blob_in_image(), blob) != Status::ok) return 2;
    const Lattice lattice = lattice_of(blob);
    Steps steps;
    BoxInSteps box;
    if (to_steps(lattice, lattice.origin, steps) != QueryStatus::ok ||
        steps_around(lattice, {lattice.origin, lattice.origin}, box) != QueryStatus::ok)
        return 3;
    HitInSteps hit;
    bool any = overlaps(blob, box);
    Triangle page[4];
    const OverlapPage found = collect_overlaps(blob, box, page);
    const bool saw_all = for_each_overlap(blob, box, [](Triangle) { return keep_going; });
    if (first_hit(blob, {steps, {8, 8, 5000}}, hit) != QueryStatus::ok) return 4;
    if (any_hit(blob, {steps, {8, 8, 5000}}, any) != QueryStatus::ok) return 5;
    return any && saw_all && found.count != 0 ? 0 : 1;
}
