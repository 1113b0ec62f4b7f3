#include "measure.hpp"

#include <thread>

#include "../../tools/base/choices.hpp"

namespace espalier::bench {
namespace {

void add_length(JsonObject& object, const char* name, std::optional<double> value) {
    object.add_raw(name, value ? digits_of(*value, 6) : "null");
}

void add_ratio(JsonObject& object, const std::string& name, const std::optional<Spread>& ratio) {
    object.add_raw(name + "_ratio", ratio ? decimal(ratio->median, 3) : "null");
    std::string range = "null";
    if (ratio) range = '[' + decimal(ratio->low, 3) + ',' + decimal(ratio->high, 3) + ']';
    object.add_raw(name + "_spread", range);
}

}  // namespace

void print_rows(const MeshResult& result, const Options& options) {
    for (const Row& row : result.rows) {
        JsonObject object;
        object.add("system", row.system);
        object.add("profile", row.profile);
        object.add("version", row.version);
        object.add("mesh", result.mesh);
        object.add("triangles", result.triangles);
        object.add("bits", std::size_t{options.bake.bits});
        object.add("effort", tools::name_in(tools::effort_choices, options.bake.effort));
        object.add("builder", tools::name_in(tools::builder_choices, options.bake.builder));
        object.add("rays", options.incoherent);
        object.add("seed", std::size_t{options.seed});
        object.add("repetitions", std::size_t{options.repetitions});
        object.add("builds", std::size_t{options.builds});
        object.add("instruction_set", instruction_set_name());
        object.add("processor", processor());
        object.add("compiler", compiler());
        object.add("date", today());
        object.add("processors", std::size_t{std::thread::hardware_concurrency()});
        object.add("load", result.load, 2);
        object.add("bytes_per_triangle", row.bytes_per_triangle, 3);
        object.add("bytes_per_triangle_20_bits", row.bytes_per_triangle_20_bits, 3);
        object.add("bytes_per_triangle_with_ids", row.bytes_per_triangle_with_ids, 3);
        const bool rounded = row.lattice.has_value();
        add_length(object, "step", rounded ? std::optional(row.lattice->step) : std::nullopt);
        add_length(object, "extent", rounded ? std::optional(row.lattice->extent) : std::nullopt);
        add_length(object, "max_error", rounded ? std::optional(row.lattice->max_error) : std::nullopt);
        add_ratio(object, "incoherent", row.incoherent.ratio);
        add_ratio(object, "coherent", row.coherent.ratio);
        add_ratio(object, "any", row.any.ratio);
        add_ratio(object, "build", row.build_ratio);
        object.add("incoherent_mrays", row.incoherent.mrays, 3);
        object.add("coherent_mrays", row.coherent.mrays, 3);
        object.add("any_mrays", row.any.mrays, 3);
        object.add("build_seconds", row.build_seconds, 4);
        object.add("hit_fraction", row.hit_fraction, 4);
        object.add("disagreeing", row.disagreeing);
        object.add("t_disagreeing", row.t_disagreeing);
        object.add("any_contradictions", row.any_contradictions);
        object.print();
    }
    std::fflush(stdout);
}

}  // namespace espalier::bench
