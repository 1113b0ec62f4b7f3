// Runs the workload between marks: query_meter, the plugin, sees what each query costs.
#include <espalier/espalier.hpp>

#include "../workload.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

static_assert(espalier::firmware::kind_count < espalier::firmware::end_mark);

int main() {
    using namespace espalier;
    Blob blob;
    if (const Status status = open(firmware::blob_in_image(), blob); status != Status::ok) {
        board::print(describe(status));
        return 2;
    }
    const auto measure = [](unsigned kind, FunctionRef<void()> call) { firmware::measure(kind, call); };
    firmware::Workload workload(firmware::blob_in_image(), blob, measure);
    board::print(firmware::workload_line(workload.run({})).c_str());
    return 0;
}
