#include "subject.hpp"

#include "../instruction_set.hpp"
#include "../machine.hpp"

namespace espalier::bench {
namespace {

Mesh at_common_size(Mesh mesh) {
    bring_to_common_size(mesh);
    return mesh;
}

}  // namespace

Subject::Subject(Mesh mesh, const Options& options)
    : options_(options),
      moving_(at_common_size(std::move(mesh))),
      poses_(poses_of(moving_, options.times)),
      range_(range_of(moving_, poses_)) {}

JsonObject Subject::row(const std::string& measures) const {
    JsonObject row;
    row.add("measures", measures);
    row.add("mesh", rest().name);
    row.add("triangles", rest().triangles.size());
    row.add("positions", rest().positions.size());
    row.add("bits", std::size_t{options_.bits});
    row.add("rounds", options_.rounds);
    row.add("espalier", std::string(ESPALIER_BENCH_VERSION));
    row.add("processor", processor());
    row.add("instruction_set", instruction_set_name());
    row.add("compiler", compiler());
    row.add("date", today());
    return row;
}

}  // namespace espalier::bench
