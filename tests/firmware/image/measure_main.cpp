// Runs the workload between marks: query_meter, the plugin, sees what each query costs. As measure.elf every query, as
// measure_usual.elf those alone that it is named after: for meshes that leave no room for more code, or take too long.
#include <espalier/espalier.hpp>

#include "../workload.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

static_assert(espalier::firmware::kind_count < espalier::firmware::end_mark);

int main() {
    using namespace espalier;
    const Blob blob = open(firmware::blob_in_image());
    if (!blob) {
        board::print(describe(blob.status()));
        return 2;
    }
    const auto measure = [](unsigned kind, FunctionRef<void()> call) { firmware::measure(kind, call); };
    firmware::Workload workload(firmware::blob_in_image(), blob, measure);
    workload.ask_usual({});
#if ESPALIER_EVERY_QUERY
    workload.ask_others({});
#endif
    board::print(firmware::workload_line(workload.answers()).c_str());
    return 0;
}
