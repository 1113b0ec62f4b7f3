// Runs the workload of moving scenes between marks, as measure_main.cpp does that of blobs.
#include <espalier/blob.hpp>

#include "../../platform/report.hpp"
#include "../moving_workload.hpp"
#include "../workload.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

int main() {
    using namespace espalier;
    const Blob cube = open(firmware::blob_in_image());
    if (!cube) {
        board::print(describe(cube.status()));
        return 2;
    }
    alignas(32) std::byte block[firmware::mover_block_bytes];  // on the stack: what lies elsewhere is not written
    const auto measure = [](unsigned kind, FunctionRef<void()> call) { firmware::measure(kind, call); };
    firmware::MovingWorkload workload(block, cube, measure);
    workload.ask(firmware::Counts{}.steps);
    board::print(firmware::workload_line(workload.answers()).c_str());
    return 0;
}
