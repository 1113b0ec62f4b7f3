#include "turns.hpp"

namespace espalier::bench {
namespace {

double for_each_triangle(std::size_t bytes, const Baking& baking) {
    return static_cast<double>(bytes) / static_cast<double>(baking.triangles);
}

}  // namespace

void print_row(const Heading& heading, const Baking& baking, const std::string& questions,
               const std::optional<Comparison>& comparison) {
    JsonObject object;
    object.add("base", heading.base);
    object.add("other", heading.other);
    object.add("processor", processor());
    object.add("instruction_set", baking.set);
    object.add("base_compiler", heading.base_compiler);
    object.add("other_compiler", heading.other_compiler);
    object.add("bits", std::size_t{heading.bits});
    object.add("mesh", baking.mesh);
    object.add("triangles", baking.triangles);
    object.add("profile", baking.profile);
    object.add("base_bytes_per_triangle", for_each_triangle(baking.base_bytes, baking), 4);
    object.add("other_bytes_per_triangle", for_each_triangle(baking.other_bytes, baking), 4);
    object.add("same_bytes", baking.same_bytes);
    object.add("questions", questions);
    const auto number = [&](const char* name, double Ratio::*field, double factor, int digits) {
        object.add(name, comparison ? std::optional(factor * comparison->ratio.*field) : std::nullopt, digits);
    };
    number("ratio", &Ratio::median, 1.0, 4);
    number("ratio_low", &Ratio::low, 1.0, 4);
    number("ratio_high", &Ratio::high, 1.0, 4);
    number("base_ns", &Ratio::base_seconds, 1e9, 2);
    object.add("queries", comparison ? std::optional(comparison->questions) : std::nullopt);
    object.add("found", comparison ? std::optional(comparison->found) : std::nullopt);
    object.add("differing", comparison ? std::optional(comparison->differing) : std::nullopt);
    if (comparison && comparison->slow_cases) {
        object.add("other_median_ns", std::optional(1e9 * comparison->slow_cases->median_seconds), 2);
        object.add("other_percentile_99_ns", std::optional(1e9 * comparison->slow_cases->percentile_99_seconds), 2);
    }
    object.print();
    std::fflush(stdout);
}

}  // namespace espalier::bench
