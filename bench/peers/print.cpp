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

std::string with_spread(const std::optional<Spread>& ratio) {
    if (!ratio) return "-";
    return decimal(ratio->median, 2) + " (" + decimal(ratio->low, 2) + "-" + decimal(ratio->high, 2) + ")";
}

std::string or_dash(const std::optional<double>& value, int digits) { return value ? decimal(*value, digits) : "-"; }

std::string or_dash(const std::optional<std::size_t>& value) { return value ? std::to_string(*value) : "-"; }

}  // namespace

void print_json(const MeshResult& result, const Options& options) {
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

void print_table(const MeshResult& result, const Options& options) {
    std::printf("%s, %zu triangles", result.mesh.c_str(), result.triangles);
    for (const Row& row : result.rows)
        if (row.lattice) {
            std::printf("; %u-bit lattice: step %.6g, extent %.6g", options.bake.bits, row.lattice->step,
                        row.lattice->extent);
            break;
        }
    std::printf("\n%-9s %-14s %8s %8s %8s  %-18s %-18s %-18s %-18s %7s %8s %7s %7s %5s\n", "system", "profile", "B/tri",
                "20 bits", "with ids", "incoherent", "coherent", "any", "build", "Mray/s", "build s", "differ", "t",
                "any");
    for (const Row& row : result.rows)
        std::printf("%-9s %-14s %8.2f %8s %8.2f  %-18s %-18s %-18s %-18s %7s %8.4f %7s %7s %5s\n", row.system.c_str(),
                    row.profile.c_str(), row.bytes_per_triangle, or_dash(row.bytes_per_triangle_20_bits, 2).c_str(),
                    row.bytes_per_triangle_with_ids, with_spread(row.incoherent.ratio).c_str(),
                    with_spread(row.coherent.ratio).c_str(), with_spread(row.any.ratio).c_str(),
                    with_spread(row.build_ratio).c_str(), or_dash(row.incoherent.mrays, 2).c_str(), row.build_seconds,
                    or_dash(row.disagreeing).c_str(), or_dash(row.t_disagreeing).c_str(),
                    or_dash(row.any_contradictions).c_str());
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace espalier::bench
