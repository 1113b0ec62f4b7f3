#include <baker/input/check_input.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <baker/base/number_text.hpp>
#include <baker/input/zero_area.hpp>

namespace espalier::baker {

namespace {

constexpr unsigned max_effort = 9;
constexpr float most_expensive = 1e6f;   // sums over all nodes stay far from infinity, which means impossible there
constexpr double max_flat_angle = 90.0;  // degrees; an angle that can be called flat is below this
constexpr const char* corner_names[3] = {"first", "second", "third"};

BakeError invalid_options(std::string message) { return {BakeError::Kind::invalid_options, std::move(message)}; }
BakeError too_large(std::string message, SourcePlace place) {
    return {BakeError::Kind::too_large, std::move(message), place};
}

bool is_finite(const Vec3& point) { return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z); }

std::string text_of(float value) { return std::isnan(value) ? "NaN" : value > 0 ? "infinity" : "-infinity"; }

/// What is wrong with the first coordinate of a corner that is not finite: "the second corner has y = NaN".
std::string describe_not_finite(const MeshView& mesh, const TriangleVertices& triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vec3& point = mesh.positions[triangle[corner]];
        const std::string start = std::string("its ") + corner_names[corner] + " corner (vertex " +
                                  std::to_string(triangle[corner]) + ") has ";
        if (!std::isfinite(point.x)) return start + "x = " + text_of(point.x);
        if (!std::isfinite(point.y)) return start + "y = " + text_of(point.y);
        if (!std::isfinite(point.z)) return start + "z = " + text_of(point.z);
    }
    return {};
}

std::string describe_out_of_range(const MeshView& mesh, const TriangleVertices& triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
        if (triangle[corner] >= mesh.positions.size()) {
            return std::string("its ") + corner_names[corner] + " corner is vertex " +
                   std::to_string(triangle[corner]) + ", but the mesh has " + std::to_string(mesh.positions.size()) +
                   " vertices";
        }
    }
    return {};
}

/// Arrays that do not belong together, and sums that no blob can number.
std::optional<BakeError> check_sizes(std::span<const MeshView> meshes) {
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const MeshView& mesh = meshes[i];
        if (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size()) {
            return BakeError{BakeError::Kind::invalid_mesh,
                             mesh_name(meshes, i) + ": " + std::to_string(mesh.materials.size()) + " materials for " +
                                 std::to_string(mesh.triangles.size()) +
                                 " triangles; give one for each triangle, or none at all",
                             place_of(mesh)};
        }
        triangles += mesh.triangles.size();
        vertices += mesh.positions.size();
        if (triangles > format::max_triangles) {
            return too_large(mesh_name(meshes, i) + ": with this mesh there are " + std::to_string(triangles) +
                                 " triangles; a blob holds at most " + std::to_string(format::max_triangles) +
                                 "; split the input into several blobs",
                             place_of(mesh));
        }
        if (vertices > std::numeric_limits<std::uint32_t>::max()) {
            return too_large(
                mesh_name(meshes, i) + ": with this mesh there are " + std::to_string(vertices) +
                    " vertices; at most 4294967295 can be baked at once; split the input into several blobs",
                place_of(mesh));
        }
    }
    return std::nullopt;
}

std::optional<BakeError> check_materials(std::span<const MeshView> meshes, Materials width) {
    if (width == Materials::none) return std::nullopt;
    const std::uint32_t largest = width == Materials::bits_8 ? 0xFF : 0xFFFF;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        for (std::size_t triangle = 0; triangle < meshes[i].materials.size(); ++triangle) {
            const std::uint32_t material = meshes[i].materials[triangle];
            if (material <= largest) continue;
            SourcePlace place = place_of(meshes[i]);
            place.triangle = static_cast<std::uint32_t>(triangle);
            return too_large(mesh_name(meshes, i) + ", triangle " + std::to_string(triangle) + ": material " +
                                 std::to_string(material) + " does not fit into " +
                                 (width == Materials::bits_8 ? "8 bits (at most 255); bake with 16-bit materials"
                                                             : "16 bits (at most 65535); number the materials anew"),
                             place);
        }
    }
    return std::nullopt;
}

void count(Finding& finding, const Source& source, std::uint32_t original_id) {
    if (finding.count++ == 0) finding = first_finding(source, original_id);
}

/// The first broken triangle of all meshes.
struct Complaint {
    std::uint32_t original_id;
    std::string message;
};

/// Takes over one mesh. Sets `complaint` at the first broken triangle, if it is empty.
void append_mesh(const MeshView& mesh, std::uint32_t first_vertex, std::uint32_t first_triangle, Source& source,
                 BakeReport& report, std::optional<Complaint>& complaint) {
    const std::size_t vertex_count = mesh.positions.size();
    source.positions.insert(source.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const TriangleVertices& triangle = mesh.triangles[i];
        const std::uint32_t id = first_triangle + static_cast<std::uint32_t>(i);
        if (triangle[0] >= vertex_count || triangle[1] >= vertex_count || triangle[2] >= vertex_count) {
            count(report.index_out_of_range, source, id);
            if (!complaint) complaint = {id, triangle_name(source, id) + ": " + describe_out_of_range(mesh, triangle)};
            continue;
        }
        const Vec3& a = mesh.positions[triangle[0]];
        const Vec3& b = mesh.positions[triangle[1]];
        const Vec3& c = mesh.positions[triangle[2]];
        if (!is_finite(a) || !is_finite(b) || !is_finite(c)) {
            count(report.not_finite, source, id);
            if (!complaint) complaint = {id, triangle_name(source, id) + ": " + describe_not_finite(mesh, triangle)};
            continue;
        }
        const SourceTriangle sound{{first_vertex + triangle[0], first_vertex + triangle[1], first_vertex + triangle[2]},
                                   id};
        if (has_zero_area(a, b, c)) {
            count(report.zero_area, source, id);
            source.without_area.push_back(sound);
        } else {
            source.triangles.push_back(sound);
        }
    }
}

std::optional<BakeError> check_cost_model(const CostModel& model) {
    const std::pair<const char*, float> costs[] = {{"node_visit", model.node_visit},
                                                   {"leaf_visit", model.leaf_visit},
                                                   {"leaf_group", model.leaf_group},
                                                   {"triangle", model.triangle},
                                                   {"byte_price", model.byte_price}};
    for (const auto& [name, cost] : costs) {
        if (std::isfinite(cost) && cost >= 0.0f && cost <= most_expensive) continue;
        return invalid_options(std::string("the cost model's ") + name + " is " + number_text(double(cost)) +
                               "; choose a number from 0 to " + number_text(double(most_expensive)));
    }
    return std::nullopt;
}

}  // namespace

std::optional<BakeError> check_options(const BakeOptions& options) {
    if (options.bits < 1 || options.bits > unsigned{format::max_bits}) {
        return invalid_options("bits is " + std::to_string(options.bits) + "; choose 1 to " +
                               std::to_string(format::max_bits));
    }
    if (options.tolerance && !(std::isfinite(*options.tolerance) && *options.tolerance > 0.0)) {
        return invalid_options("the tolerance is " + number_text(*options.tolerance) +
                               "; choose a length above zero, in the units of the mesh");
    }
    if (options.effort > max_effort) {
        return invalid_options("effort is " + std::to_string(options.effort) + "; choose 0 (fastest) to " +
                               std::to_string(max_effort) + " (best)");
    }
    if (options.max_leaf_triangles < 1 || options.max_leaf_triangles > format::max_leaf_triangles) {
        return invalid_options("max_leaf_triangles is " + std::to_string(options.max_leaf_triangles) +
                               "; choose 1 to " + std::to_string(format::max_leaf_triangles));
    }
    if (auto error = check_cost_model(options.cost_model)) return error;
    if (options.profile > format::Profile::tiny) {
        return invalid_options("profile " + std::to_string(static_cast<unsigned>(options.profile)) +
                               " is not known; choose fast, balanced, small or tiny");
    }
    if (options.builder > Builder::insertion) {
        return invalid_options("builder " + std::to_string(static_cast<unsigned>(options.builder)) +
                               " is not known; choose one of Builder in bake.hpp");
    }
    if (options.builder == Builder::spatial_splits && options.profile != format::Profile::fast) {
        return invalid_options(
            "spatial splits need the profile fast: the strips of other profiles turn triangles, and copies of one must "
            "be alike; choose profile fast or another builder");
    }
    if (!(options.duplicates >= 0.0 && options.duplicates <= 1.0)) {
        return invalid_options("duplicates is " + number_text(options.duplicates) +
                               "; choose a share of the triangles, 0 to 1");
    }
    if (options.materials > Materials::bits_16) {
        return invalid_options("materials is " + std::to_string(static_cast<unsigned>(options.materials)) +
                               "; choose none, 8 bits or 16 bits");
    }
    if (options.step_exponent) {
        if (options.tolerance)
            return invalid_options(
                "a step and a tolerance were both given; either of them fixes the lattice: choose one");
        if (*options.step_exponent < format::min_step_exponent || *options.step_exponent > format::max_step_exponent)
            return invalid_options("the step is 2^" + std::to_string(*options.step_exponent) + "; choose one from 2^" +
                                   std::to_string(format::min_step_exponent) + " to 2^" +
                                   std::to_string(format::max_step_exponent));
    }
    if (options.edge_flags && !(*options.edge_flags >= 0.0 && *options.edge_flags < max_flat_angle)) {
        return invalid_options("the largest angle of a flat edge is " + number_text(*options.edge_flags) +
                               " degrees; choose 0 or more, below " + number_text(max_flat_angle));
    }
    return std::nullopt;
}

Result<Source, BakeError> check_input(std::span<const MeshView> meshes, const BakeOptions& options,
                                      BakeReport& report) {
    if (auto error = check_sizes(meshes)) return *error;
    if (auto error = check_materials(meshes, options.materials)) return *error;

    Source source;
    source.meshes = meshes;
    std::size_t vertex_count = 0;
    for (const MeshView& mesh : meshes) {
        source.first_triangle.push_back(source.triangle_count);
        source.triangle_count += static_cast<std::uint32_t>(mesh.triangles.size());
        vertex_count += mesh.positions.size();
    }
    source.positions.reserve(vertex_count);
    source.triangles.reserve(source.triangle_count);
    report.source_triangles = source.triangle_count;
    report.source_vertices = vertex_count;

    std::optional<Complaint> complaint;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const auto first_vertex = static_cast<std::uint32_t>(source.positions.size());
        append_mesh(meshes[i], first_vertex, source.first_triangle[i], source, report, complaint);
    }
    const std::uint64_t broken = report.not_finite.count + report.index_out_of_range.count;
    if (complaint && !options.repair) {
        return BakeError{BakeError::Kind::invalid_mesh,
                         complaint->message + ". Broken triangles: " + std::to_string(broken) +
                             ". Mend the mesh, or bake with repair to drop them",
                         place_of(source, complaint->original_id)};
    }
    return source;
}

}  // namespace espalier::baker
