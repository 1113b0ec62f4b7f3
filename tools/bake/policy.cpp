#include "policy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

#include <baker/input/zero_area.hpp>
#include <baker/policy.hpp>
#include <import/base/numbers.hpp>

#include "baking.hpp"
#include "base/choices.hpp"

namespace espalier::tools {

namespace {

constexpr std::array unit_names{"um", "mm", "cm", "in", "ft", "m", "km"};

AssetPolicy::SizeRange parse_size_range(const std::string& words) {
    constexpr const char* option = "--expect-size";
    const std::size_t dots = words.find("..");
    if (dots == std::string::npos) {
        throw_error(ExitCode::usage, option, " '", printable(words),
                    "': write the least and the largest size with '..' between: "
                    "0.1m..10m.");
    }
    AssetPolicy::SizeRange range{parse_length(words.substr(0, dots), option),
                                 parse_length(words.substr(dots + 2), option), words};
    if (range.least < 0.0 || range.most < range.least) {
        throw_error(ExitCode::usage, option, " '", printable(words),
                    "': the least size is zero or more, and the largest no smaller.");
    }
    return range;
}

void refuse_dropped(const AssetPolicy& policy, const ImportResult& imported, const BakeReport& report) {
    const baker::LostTriangles lost = baker::lost_triangles(report);
    if (!lost.are_more_than(policy.max_dropped)) return;
    ErrorDetails details;
    if (lost.place) details = details_of(*lost.place, imported);
    details.kind = "dropped";
    const bool is_empty = report.tree.triangles == 0 && !policy.allow_empty;
    throw CommandError(
        ExitCode::invalid_input,
        text("dropped ", lost.count, " of ", counted(lost.of, "triangle"), ": ", lost.words, ". At most ",
             rounded(policy.max_dropped), " % may be, so nothing was written. Mend the mesh",
             report.findings.collapsed.count > 0 ? " or choose a finer lattice" : "", "; if the loss is intended, ",
             "raise --max-dropped", is_empty ? " and give --allow-empty." : "."),
        std::move(details));
}

void refuse_empty(const AssetPolicy& policy, const ImportResult& imported, const BakeReport& report) {
    if (policy.allow_empty || report.tree.triangles != 0) return;
    throw CommandError(ExitCode::invalid_input,
                       text(names_of_inputs(imported),
                            ": no triangle is left, so nothing was written. Check the "
                            "input; if an empty blob is intended, give --allow-empty."),
                       {.file = only_input(imported), .kind = "empty"});
}

bool is_within(const AssetPolicy::SizeRange& range, const AssetSize& size) {
    return size.extent + size.uncertainty >= range.least && size.extent - size.uncertainty <= range.most;
}

/// " --unit mm makes it 0.36 m." for each unit with which the size is as expected.
std::string unit_hints(const AssetPolicy::SizeRange& range, const ImportResult& imported, const AssetSize& size) {
    const double now = imported.files.front().metres_per_unit;
    for (const ImportedFile& file : imported.files)
        if (file.metres_per_unit != now) return {};
    std::string hints;
    for (const char* unit : unit_names) {
        const double factor = *metres_in(unit) / now;
        const AssetSize other{size.extent * factor, size.uncertainty * factor};
        if (!is_within(range, other)) continue;
        hints += text(hints.empty() ? " " : ", ", "--unit ", unit, " makes it ", rounded(other.extent, 4), " m");
    }
    return hints.empty() ? hints : hints + ".";
}

std::string unit_advice(const AssetPolicy::SizeRange& range, const ImportResult& imported, const AssetSize& size) {
    std::string hints = unit_hints(range, imported, size);
    return hints.empty() ? " Check the unit of its file, which --unit states." : hints;
}

void refuse_size(const AssetPolicy& policy, const ImportResult& imported, const BakeReport& report) {
    if (!policy.expected_size || report.tree.triangles == 0) return;
    const AssetPolicy::SizeRange& range = *policy.expected_size;
    const AssetSize size = asset_size(imported);
    if (is_within(range, size)) return;
    throw CommandError(
        ExitCode::invalid_input,
        text(names_of_inputs(imported), ": the asset is ", rounded(size.extent), " m across, outside of --expect-size ",
             printable(range.words), ", so nothing was written.", unit_advice(range, imported, size)),
        {.file = only_input(imported), .kind = "size"});
}

bool is_sound(const ImportedMesh& mesh, const TriangleVertices& triangle) {
    const auto is_there = [&mesh](std::uint32_t vertex) {
        return vertex < mesh.positions.size() && is_finite(mesh.positions[vertex]);
    };
    return std::all_of(triangle.begin(), triangle.end(), is_there) &&
           !baker::has_zero_area(mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]);
}

/// Returns the vertices of triangles with an area, ascending.
std::vector<std::uint32_t> sound_vertices(const ImportedMesh& mesh) {
    std::vector<bool> is_used(mesh.positions.size());
    for (const TriangleVertices& triangle : mesh.triangles) {
        if (!is_sound(mesh, triangle)) continue;
        for (const std::uint32_t vertex : triangle) is_used[vertex] = true;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t vertex = 0; vertex < is_used.size(); ++vertex)
        if (is_used[vertex]) result.push_back(vertex);
    return result;
}

/// Formats of decimal numbers, which are read in float64. Others hold float32, or may.
constexpr std::array<std::string_view, 4> decimal_formats{"Wavefront OBJ", "OFF", "RAW", "3MF"};

/// Returns by which share of a coordinate a size may be off. Of two corners, each may have been rounded when it was
/// made and when it was placed, each time by half a unit in the last place: that of float32, or for decimals that of
/// float64, where the unit, the axes and nested transforms add roundings of their own.
double uncertainty_of(const ImportResult& imported) {
    const auto has_decimals = [](const ImportedFile& file) {
        return std::find(decimal_formats.begin(), decimal_formats.end(), file.format) != decimal_formats.end();
    };
    return std::all_of(imported.files.begin(), imported.files.end(), has_decimals) ? 0x1p-46 : 0x1p-22;
}

}  // namespace

AssetPolicy asset_policy(const BakeArguments& arguments) {
    AssetPolicy policy;
    policy.strict = arguments.source.strict;
    policy.allow_empty = arguments.source.allow_empty;
    policy.max_dropped = arguments.max_dropped;
    if (!arguments.expected_size.empty()) policy.expected_size = parse_size_range(arguments.expected_size);
    return policy;
}

void enforce(const AssetPolicy& policy, const ImportResult& imported, const BakeReport& report,
             std::span<const Warning> warnings) {
    if (!policy.allow_empty) refuse_empty_files(imported);
    refuse_dropped(policy, imported, report);
    refuse_empty(policy, imported, report);
    refuse_size(policy, imported, report);
    if (policy.strict) refuse_warnings(warnings, imported);
}

std::string only_input(const ImportResult& imported) {
    return imported.files.size() == 1 ? imported.files.front().path : std::string();
}

std::string names_of_inputs(const ImportResult& imported) {
    std::string names;
    for (const ImportedFile& file : imported.files)
        names += text(names.empty() ? "'" : ", '", printable(file.path), '\'');
    return names;
}

void refuse_empty_files(const ImportResult& imported) {
    for (const ImportedFile& file : imported.files) {
        if (file.triangles != 0) continue;
        // A warning about what was left out has a remedy of its own.
        const std::string cause = file.warnings.empty() ? "Check the file." : file.warnings.front().message;
        throw CommandError(ExitCode::invalid_input,
                           text("'", printable(file.path), "': the input has no triangles. ", cause,
                                " If that is intended, give --allow-empty."),
                           {.file = file.path, .kind = "empty"});
    }
}

void refuse_warnings(std::span<const Warning> warnings, const ImportResult& imported) {
    if (warnings.empty()) return;
    const Warning& first = warnings.front();
    throw CommandError(ExitCode::invalid_input,
                       text(first.file.empty() ? names_of_inputs(imported) : text('\'', printable(first.file), '\''),
                            ": --strict refuses ", counted(warnings.size(), "warning"), ": ",
                            listed(warnings, ", ", &Warning::kind), ". Nothing was written."),
                       {first.file, first.mesh, first.triangle, "strict"});
}

AssetSize asset_size(const ImportResult& imported) {
    std::vector<std::vector<std::uint32_t>> vertices;
    for (const ImportedMesh& mesh : imported.meshes) vertices.push_back(sound_vertices(mesh));
    PointBox bounds;
    for (const ImportedPlace& place : imported.places) {
        for (const std::uint32_t vertex : vertices[place.mesh])
            bounds.add(place.placement(imported.meshes[place.mesh].positions[vertex]));
    }
    for (std::size_t i = 0; imported.places.empty() && i < vertices.size(); ++i) {
        for (const std::uint32_t vertex : vertices[i]) bounds.add(imported.meshes[i].positions[vertex]);
    }
    const double uncertainty = uncertainty_of(imported);
    AssetSize size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = bounds.low[axis], high = bounds.high[axis];
        if (high - low <= size.extent) continue;
        size = {high - low, std::max(std::abs(low), std::abs(high)) * uncertainty};
    }
    return size;
}

}  // namespace espalier::tools
