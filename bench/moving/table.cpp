#include "turns.hpp"

namespace espalier::bench::moving {
namespace {

constexpr const char* part_names[part_count] = {"update", "refit", "repack", "pairs"};

const char* name_of(Sizes sizes) { return sizes == Sizes::cubes ? "cubes" : "mixed"; }

/// What a row states.
struct Line {
    std::string from;
    Steps steps;
    const Measured* measured;
};

double microseconds(double seconds) { return 1e6 * seconds; }

/// Returns the median of a part over the steps that have it, 0 if none has.
double part_median(const Measured& measured, std::size_t part) {
    Steps steps;
    for (const double seconds : measured.parts[part])
        if (seconds > 0.0) steps.push_back(seconds);
    return steps.empty() ? 0.0 : median_of(steps);
}

std::vector<Line> lines_of(const std::vector<Measured>& all) {
    std::vector<Line> from_boxes, from_placements;
    const Measured* loop = nullptr;
    for (const Measured& one : all)
        if (one.finds == Finds::none) loop = &one;
    for (const Measured& one : all) {
        (one.from == "boxes" ? from_boxes : from_placements).push_back({one.from, one.steps, &one});
        if (one.from != "boxes" || loop == nullptr || one.name.starts_with("espalier")) continue;
        Line& both = from_placements.emplace_back(Line{"placements", one.steps, &one});
        for (std::size_t i = 0; i < both.steps.size(); ++i) both.steps[i] += loop->steps[i];
    }
    from_boxes.insert(from_boxes.end(), from_placements.begin(), from_placements.end());
    return from_boxes;
}

const Line& reference_of(const std::vector<Line>& lines, const Line& line) {
    for (const Line& other : lines)
        if (other.from == line.from && other.measured->name == "espalier") return other;
    return lines.front();
}

void print_row(const Line& line, const Line& reference, const Scenario& scenario, const std::string& measures) {
    JsonObject row = row_of(scenario, measures);
    row.add("system", line.measured->name);
    row.add("from", line.from);
    row.add("median_us", microseconds(median_of(line.steps)), 2);
    row.add("mean_us", microseconds(mean_of(line.steps)), 2);
    row.add("slowest_us", microseconds(slowest_of(line.steps)), 2);
    row.add("ratio_of_medians", median_of(line.steps) / median_of(reference.steps), 3);
    row.add("ratio_of_means", mean_of(line.steps) / mean_of(reference.steps), 3);
    if (line.from == line.measured->from)
        for (std::size_t i = 0; i < part_count; ++i)
            row.add(std::string(part_names[i]) + "_us", microseconds(part_median(*line.measured, i)), 2);
    row.add("pairs", line.measured->pairs);
    row.add("differing_steps", line.measured->differing_steps);
    row.add("differing_pairs", line.measured->differing_pairs);
    row.print();
}

}  // namespace

JsonObject row_of(const Scenario& scenario, const std::string& measures) {
    JsonObject row;
    row.add("measures", measures);
    row.add("objects", scenario.objects);
    row.add("sizes", name_of(scenario.sizes));
    row.add("speed", scenario.speed, 3);
    row.add("moving", scenario.moving, 3);
    row.add("turning", scenario.turning);
    row.add("unmeasured", scenario.unmeasured);
    row.add("steps", scenario.steps);
    row.add("repeats", scenario.repeats);
    add_machine(row);
    return row;
}

void print_steps(const std::vector<Measured>& measured, const Scenario& scenario, const std::string& measures) {
    const std::vector<Line> lines = lines_of(measured);
    for (const Line& line : lines) print_row(line, reference_of(lines, line), scenario, measures);
    std::fflush(stdout);
}

}  // namespace espalier::bench::moving
