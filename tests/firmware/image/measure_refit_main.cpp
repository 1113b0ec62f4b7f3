// Runs the workload of refits between marks, as measure_main.cpp does that of queries.
#include <espalier/blob.hpp>

#include "../../platform/report.hpp"
#include "../refit_workload.hpp"
#include "../workload.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

int main() {
    using namespace espalier;
    const Blob cloth = open(firmware::blob_in_image());
    if (!cloth) {
        board::print(describe(cloth.status()));
        return 2;
    }
    if (deformable_bytes(cloth) > firmware::most_cloth_bytes) return 3;
    std::byte memory[firmware::most_cloth_bytes];  // on the stack: what lies elsewhere is not written
    Vec3 positions[firmware::ClothPlaces::count];
    const auto measure = [](unsigned kind, FunctionRef<void()> call) { firmware::measure(kind, call); };
    firmware::RefitWorkload workload(memory, positions, cloth, measure);
    workload.ask(firmware::Counts{}.poses);
    board::print(firmware::workload_line(workload.answers()).c_str());
    return 0;
}
