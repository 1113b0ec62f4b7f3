#include "turns.hpp"

namespace espalier::bench {
namespace {

double for_each_triangle(std::size_t bytes, const Baking& baking) {
    return static_cast<double>(bytes) / static_cast<double>(baking.triangles);
}

}  // namespace

void print_heading(const Heading& heading) {
    std::printf("base   %s (%s)\nother  %s (%s)\non     %s\n", heading.base.c_str(), heading.base_compiler.c_str(),
                heading.other.c_str(), heading.other_compiler.c_str(), processor().c_str());
    std::printf("A ratio is the other's time by the base's: below 1 the other is faster.\n");
    std::fflush(stdout);
}

void print_baking(const Baking& baking) {
    std::printf("\n%s, %zu triangles, %s, %s: %.3f and %.3f bytes a triangle, %s blobs\n", baking.mesh.c_str(),
                baking.triangles, baking.profile.c_str(), baking.set.c_str(),
                for_each_triangle(baking.base_bytes, baking), for_each_triangle(baking.other_bytes, baking),
                baking.same_bytes ? "equal" : "different");
    std::printf("  %-30s %12s %7s  %-15s %9s %9s  %s\n", "questions", "base ns each", "ratio", "pairs of loads",
                "asked", "found", "differ");
    std::fflush(stdout);
}

void print_row(const std::string& questions, const std::optional<Comparison>& comparison) {
    if (!comparison) std::printf("  %-30s not in both commits\n", questions.c_str());
    else
        std::printf("  %-30s %12.1f %7.3f  %.3f to %.3f  %9zu %9zu  %zu\n", questions.c_str(),
                    1e9 * comparison->ratio.base_seconds, comparison->ratio.median, comparison->ratio.low,
                    comparison->ratio.high, comparison->questions, comparison->found, comparison->differing);
    if (comparison && comparison->slow_cases) {
        const SlowCases& slow = *comparison->slow_cases;
        std::printf("    of %zu one by one, other: median %.1f ns, 99th percentile %.1f ns, %.1f times as long\n",
                    slow.questions, 1e9 * slow.median_seconds, 1e9 * slow.percentile_99_seconds,
                    slow.percentile_99_seconds / slow.median_seconds);
    }
    std::fflush(stdout);
}

void print_json(const Heading& heading, const Baking& baking, const std::string& questions,
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
    object.add_raw("same_bytes", baking.same_bytes ? "true" : "false");
    object.add("questions", questions);
    const auto number = [&](const char* name, double Ratio::*field, double factor, int digits) {
        object.add(name, comparison ? std::optional(factor * comparison->ratio.*field) : std::nullopt, digits);
    };
    number("ratio", &Ratio::median, 1.0, 4);
    number("ratio_low", &Ratio::low, 1.0, 4);
    number("ratio_high", &Ratio::high, 1.0, 4);
    number("base_ns", &Ratio::base_seconds, 1e9, 2);
    object.add("asked", comparison ? std::optional(comparison->questions) : std::nullopt);
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
