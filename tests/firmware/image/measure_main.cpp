// Runs a workload between marks: query_meter, the plugin, sees what each query costs. CMake chooses which one.
#include "../ask.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

using namespace espalier;

static_assert(std::size(firmware::kind_names) < firmware::end_mark);

int main() {
    const auto measure = [](firmware::Kind kind, FunctionRef<void()> call) { firmware::measure(kind.number, call); };
    const firmware::Asked asked = firmware::ESPALIER_WORKLOAD(firmware::blob_in_image(), measure);
    if (asked.status != OpenStatus::ok) {
        board::print(describe(asked.status));
        return 2;
    }
    board::print(firmware::workload_line(asked.answers).c_str());
    return 0;
}
