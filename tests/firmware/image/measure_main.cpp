// Runs the workload between marks: query_meter, the plugin, sees what each query costs.
#include <espalier/espalier.hpp>

#include "../../platform/report.hpp"
#include "../workload.hpp"
#include "blob_in_image.hpp"
#include "marks.hpp"
#include "semihosting.hpp"

namespace espalier::firmware {

extern "C" volatile std::uint32_t firmware_marks[mark_count] = {};
static_assert(kind_count < mark_count);

}  // namespace espalier::firmware

int main() {
    using namespace espalier;
    Blob blob;
    if (const Status status = open(firmware::blob_in_image(), blob); status != Status::ok) {
        firmware::print(describe(status));
        return 2;
    }
    const auto measure = [](unsigned kind, FunctionRef<void()> call) { firmware::measure(kind, call); };
    firmware::Workload workload(firmware::blob_in_image(), blob, measure);
    const platform::Fingerprint answers = workload.run({});
    platform::Line line;
    line.text("workload ");
    line.hexadecimal(answers.value());
    line.text("\n");
    firmware::print(line.c_str());
    return 0;
}
