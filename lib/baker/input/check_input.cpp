#include <baker/input/check_input.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <baker/base/float_rounding.hpp>
#include <baker/base/number_text.hpp>
#include <baker/input/check_deformation.hpp>
#include <baker/input/positions.hpp>
#include <baker/input/zero_area.hpp>

namespace espalier::baker {

namespace {

constexpr float dearest_byte = 1e6f;     // sums over all nodes stay far from infinity, which means impossible there
constexpr double max_flat_angle = 90.0;  // degrees; an angle that can be called flat is below this
constexpr const char* corner_names[3] = {"first", "second", "third"};

Refusal too_large(std::string message, SourcePlace place) { return {BakeStatus::too_large, std::move(message), place}; }

/// What is wrong with the first coordinate of a corner that is not finite: "the second corner has y = NaN".
std::string describe_not_finite(const MeshView& mesh, const Vec3d* positions, const TriangleVertices& triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::string vertex = std::string("its ") + corner_names[corner] + " corner (vertex " +
                                   std::to_string(triangle[corner]) + ") has ";
        const Vec3d given = given_position(mesh, triangle[corner]);
        if (const auto coordinate = find_not_finite(given)) return vertex + *coordinate;
        if (is_finite(positions[triangle[corner]])) continue;
        for (const double coordinate : {given.x, given.y, given.z})
            if (!(std::abs(coordinate) < 1e38))
                return vertex + "the coordinate " + number_text(coordinate) + ", beyond float32, which ends at 3.4e38";
        return vertex + "a coordinate that is, less the origin, beyond float32, which ends at 3.4e38";
    }
    return {};
}

std::string describe_out_of_range(const MeshView& mesh, const TriangleVertices& triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
        if (triangle[corner] >= mesh.position_count()) {
            return std::string("its ") + corner_names[corner] + " corner is vertex " +
                   std::to_string(triangle[corner]) + ", but the mesh has " + std::to_string(mesh.position_count()) +
                   " vertices";
        }
    }
    return {};
}

/// Arrays that do not belong together, and sums that no blob can number.
std::optional<Refusal> check_sizes(std::span<const MeshView> meshes) {
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const MeshView& mesh = meshes[i];
        if (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size()) {
            return Refusal{BakeStatus::invalid_mesh,
                           mesh_name(meshes, i) + ": " + std::to_string(mesh.materials.size()) + " materials for " +
                               std::to_string(mesh.triangles.size()) +
                               " triangles; give one for each triangle, or none at all",
                           place_of(mesh)};
        }
        if (!mesh.positions.empty() && !mesh.float64_positions.empty()) {
            return Refusal{BakeStatus::invalid_mesh,
                           mesh_name(meshes, i) + ": it has positions in float32 and in float64; give either",
                           place_of(mesh)};
        }
        triangles += mesh.triangles.size();
        vertices += mesh.position_count();
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

/// Returns the bits that hold every material, or a refusal if one takes more than 16.
Expected<unsigned> material_bits_of(std::span<const MeshView> meshes) {
    constexpr std::uint32_t largest = 0xFFFF;
    std::uint32_t all = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        for (std::size_t triangle = 0; triangle < meshes[i].materials.size(); ++triangle) {
            const std::uint32_t material = meshes[i].materials[triangle];
            all |= material;
            if (material <= largest) continue;
            SourcePlace place = place_of(meshes[i]);
            place.triangle = static_cast<std::uint32_t>(triangle);
            return too_large(mesh_name(meshes, i) + ", triangle " + std::to_string(triangle) + ": material " +
                                 std::to_string(material) +
                                 " does not fit into 16 bits (at most 65535); number the materials anew",
                             place);
        }
    }
    return all == 0 ? 0u : all <= 0xFF ? 8u : 16u;
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
void append_mesh(const MeshView& mesh, std::uint32_t first_triangle, bool keeps_flat, PositionsFromOrigin& from_origin,
                 Source& source, BakeReport& report, std::optional<Complaint>& complaint) {
    const std::size_t vertex_count = mesh.position_count();
    const auto first_vertex = static_cast<std::uint32_t>(source.positions.size());
    for (std::size_t i = 0; i < vertex_count; ++i) {
        const Vec3d given = given_position(mesh, i);
        source.positions.push_back(from_origin.at(given));
        source.is_float64 = source.is_float64 || (is_finite(given) && !fits_float32(given));
    }
    const Vec3d* const positions = source.positions.data() + first_vertex;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const TriangleVertices& triangle = mesh.triangles[i];
        const std::uint32_t id = first_triangle + static_cast<std::uint32_t>(i);
        if (triangle[0] >= vertex_count || triangle[1] >= vertex_count || triangle[2] >= vertex_count) {
            count(report.findings.index_out_of_range, source, id);
            if (!complaint) complaint = {id, triangle_name(source, id) + ": " + describe_out_of_range(mesh, triangle)};
            continue;
        }
        const Vec3d& a = positions[triangle[0]];
        const Vec3d& b = positions[triangle[1]];
        const Vec3d& c = positions[triangle[2]];
        if (!is_finite(a) || !is_finite(b) || !is_finite(c)) {
            count(report.findings.not_finite, source, id);
            if (!complaint)
                complaint = {id, triangle_name(source, id) + ": " + describe_not_finite(mesh, positions, triangle)};
            continue;
        }
        const SourceTriangle sound{{first_vertex + triangle[0], first_vertex + triangle[1], first_vertex + triangle[2]},
                                   id};
        if (!keeps_flat && has_zero_area(a, b, c)) {
            count(report.findings.zero_area, source, id);
            if (a == b || b == c || c == a) ++report.findings.equal_corners;
            source.without_area.push_back(sound);
        } else {
            source.triangles.push_back(sound);
        }
    }
}

std::optional<Refusal> check_resolution(Resolution resolution) {
    const double value = resolution.value();
    switch (resolution.kind()) {
        case Resolution::Kind::bits:
            if (value >= 1 && value <= format::max_bits) return std::nullopt;
            return invalid_options("bits is " + number_text(value) + "; choose 1 to " +
                                   std::to_string(format::max_bits));
        case Resolution::Kind::tolerance:
            if (std::isfinite(value) && value > 0.0) return std::nullopt;
            return invalid_options("the tolerance is " + number_text(value) +
                                   "; choose a length above zero, in the units of the mesh");
        case Resolution::Kind::step:
            if (value >= format::min_step_exponent && value <= format::max_step_exponent) return std::nullopt;
            return invalid_options("the step is 2^" + number_text(value) + "; choose one from 2^" +
                                   std::to_string(format::min_step_exponent) + " to 2^" +
                                   std::to_string(format::max_step_exponent));
    }
    return std::nullopt;
}

std::optional<Refusal> check_build(const BuildOptions& build, Profile profile) {
    if (build.builder > Builder::insertion) {
        return invalid_options("builder " + std::to_string(static_cast<unsigned>(build.builder)) +
                               " does not exist; choose one of Builder in bake.hpp");
    }
    if (build.builder == Builder::spatial_splits && profile != Profile::fast) {
        return invalid_options(
            "spatial splits need the profile fast: the strips of other profiles turn triangles, and copies of one must "
            "be alike; choose profile fast or another builder");
    }
    if (!(build.duplicate_budget >= 0.0 && build.duplicate_budget <= 1.0)) {
        return invalid_options("duplicate_budget is " + number_text(build.duplicate_budget) +
                               "; choose a share of the triangles, 0 to 1");
    }
    if (!(build.byte_price >= 0.0f && build.byte_price <= dearest_byte)) {
        return invalid_options("byte_price is " + number_text(double(build.byte_price)) +
                               "; choose a number from 0 to " + number_text(double(dearest_byte)));
    }
    if (build.max_leaf_triangles < 1 || build.max_leaf_triangles > format::max_leaf_triangles) {
        return invalid_options("max_leaf_triangles is " + std::to_string(build.max_leaf_triangles) + "; choose 1 to " +
                               std::to_string(format::max_leaf_triangles));
    }
    return std::nullopt;
}

}  // namespace

std::optional<Refusal> check_options(const BakeOptions& options) {
    if (auto refusal = check_resolution(options.resolution)) return refusal;
    if (options.effort > Effort::best) {
        return invalid_options("effort " + std::to_string(static_cast<unsigned>(options.effort)) +
                               " does not exist; choose fast, normal or best");
    }
    if (options.profile > Profile::tiny) {
        return invalid_options("profile " + std::to_string(static_cast<unsigned>(options.profile)) +
                               " does not exist; choose fast, balanced, small or tiny");
    }
    if (options.flat_angle && !(*options.flat_angle >= 0.0 && *options.flat_angle < max_flat_angle)) {
        return invalid_options("flat_angle, the largest angle of a flat edge, is " + number_text(*options.flat_angle) +
                               " degrees; choose 0 or more, below " + number_text(max_flat_angle));
    }
    if (options.origin && !is_finite(*options.origin)) {
        return invalid_options("the origin has " + *find_not_finite(*options.origin) + "; choose a finite place");
    }
    if (options.policy && !(options.policy->max_dropped >= 0.0 && options.policy->max_dropped <= 100.0)) {
        return invalid_options("max_dropped is " + number_text(options.policy->max_dropped) +
                               " percent of the triangles; choose 0 to 100");
    }
    if (auto refusal = check_deformation(options)) return refusal;
    return check_build(options.build, options.profile);
}

Expected<Source> check_input(std::span<const MeshView> meshes, const Vec3d& origin, const BakeOptions& options,
                             BakeReport& report) {
    if (auto refusal = check_sizes(meshes)) return *refusal;
    const auto material_bits = material_bits_of(meshes);
    if (!material_bits) return material_bits.refusal();

    Source source;
    source.meshes = meshes;
    source.material_bits = *material_bits;
    std::size_t vertex_count = 0;
    for (const MeshView& mesh : meshes) {
        source.first_triangle.push_back(source.triangle_count);
        source.triangle_count += static_cast<std::uint32_t>(mesh.triangles.size());
        vertex_count += mesh.position_count();
    }
    source.positions.reserve(vertex_count);
    source.triangles.reserve(source.triangle_count);
    report.source.triangles = source.triangle_count;
    report.source.vertices = vertex_count;

    source.origin = origin;
    report.origin = origin;
    PositionsFromOrigin from_origin(source.origin, options.deformation.has_value());
    std::optional<Complaint> complaint;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        append_mesh(meshes[i], source.first_triangle[i], options.deformation.has_value(), from_origin, source, report,
                    complaint);
    source.moved = from_origin.moved();
    const std::uint64_t broken = report.findings.not_finite.count + report.findings.index_out_of_range.count;
    if (complaint && !options.drop_bad_triangles) {
        return Refusal{BakeStatus::invalid_mesh,
                       complaint->message + ". Broken triangles: " + std::to_string(broken) + ". Mend the mesh" +
                           (options.deformation ? "" : ", or drop them with drop_bad_triangles"),
                       place_of(source, complaint->original_id)};
    }
    if (options.deformation)
        if (auto refusal = check_poses(source, *options.deformation)) return *refusal;
    return source;
}

}  // namespace espalier::baker
