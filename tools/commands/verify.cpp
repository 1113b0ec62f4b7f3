// verify: is this blob or scene sound, and is it the source it was baked from?
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <iostream>
#include <optional>
#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>
#include <espalier/import.hpp>

#include <import/base/importers.hpp>
#include <import/base/numbers.hpp>
#include <import/base/placement.hpp>

#include "bake/policy.hpp"
#include "bake/baking.hpp"
#include "base/vectors.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

namespace {

/// The source of a blob or a scene, compared with its surface: promise P3 on the file itself.
struct SourceCheck {
    std::uint64_t vertices = 0;  ///< of triangles of the source
    std::uint64_t checked = 0;   ///< evenly spread over them; none when the blob or scene is empty
    std::uint64_t too_far = 0;
    std::uint64_t triangles_with_area = 0;
    double measuring_error = 0.0;  ///< what the measured distances may be too large by, at the worst vertex
    double worst_distance = 0.0;
    std::string worst;  ///< "level.obj, mesh 3 (walls), vertex 12"
};

constexpr std::uint64_t most_checked = 100'000;

Vec3d difference(Vec3 to, Vec3 from) { return to_float64(to) - to_float64(from); }

bool has_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return cross(b - a, c - a) != Vec3d{}; }

/// What a mesh has to check.
struct UsedVertices {
    std::vector<std::uint32_t> vertices;  ///< those that some sound triangle uses, each once, ascending
    std::uint64_t triangles_with_area = 0;
};

UsedVertices used_vertices(const ImportedMesh& mesh) {
    UsedVertices result;
    std::vector<bool> used(mesh.positions.size());
    for (const TriangleVertices& triangle : mesh.triangles) {
        const auto sound = [&](std::uint32_t index) { return index < used.size() && is_finite(mesh.positions[index]); };
        if (!std::all_of(triangle.begin(), triangle.end(), sound)) continue;
        for (const std::uint32_t index : triangle) used[index] = true;
        const auto corner = [&](std::size_t number) { return mesh.positions[triangle[number]]; };
        if (has_area(corner(0), corner(1), corner(2))) ++result.triangles_with_area;
    }
    for (std::uint32_t index = 0; index < used.size(); ++index) {
        if (used[index]) result.vertices.push_back(index);
    }
    return result;
}

/// How far the measured distance may lie above the true one. closest_point answers for the point as it rounds it:
/// relative to the lattice's origin in float32, then onto a grid that is finer than the lattice as far as float32 can
/// carry it. Its distance from there is within 4 ulp (nearest.hpp).
double measuring_error_at(const Blob& blob, Vec3 point, double distance) {
    const float* origin = detail::data_of(blob).origin;
    const Vec3d offset = difference(point, {origin[0], origin[1], origin[2]});
    const double reach = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
    const int finer_by = std::clamp(23 - static_cast<int>(detail::data_of(blob).bits), 0, 6);
    const double on_each_axis = std::ldexp(1.0, blob.lattice().step_exponent - finer_by - 1) + std::ldexp(reach, -24);
    return std::sqrt(3.0) * on_each_axis + std::ldexp(distance, -21);
}

double measuring_error_at(const BakedScene& scene, Vec3 point, double distance);

/// The same for an instance. Its transform and its vertices were rounded to float32 when it was baked, and the point
/// when it was placed; to_local() rounds that, the blob again, and the result when it returns to the world.
double measuring_error_at(const BakedScene& scene, const Instance& instance, Vec3 point, double distance) {
    const Transform& transform = instance.transform;
    const auto scale = static_cast<double>(transform.scale);
    const double reach = length_of(difference(point, transform.translation));
    const double translation = length_of(to_float64(transform.translation));
    const Vec3 local = to_local(transform, point);
    const std::size_t meshes = scene.meshes().size();
    const double in_mesh = instance.mesh < meshes
                               ? measuring_error_at(scene.meshes()[instance.mesh], local, distance / scale)
                               : measuring_error_at(scene.tiles()[instance.mesh - meshes], local, distance / scale);
    return std::sqrt(3.0) * std::ldexp(reach, -19) + std::ldexp(reach, -20) + std::ldexp(translation, -23) +
           scale * in_mesh + std::ldexp(distance, -22);
}

/// The instance that is nearest may not be the one with the least measured distance: the error is the largest of all
/// that the surface near the point may belong to.
double measuring_error_at(const BakedScene& scene, Vec3 point, double distance) {
    const float around = std::nextafter(static_cast<float>(std::max(distance, static_cast<double>(scene.max_error()))),
                                        std::numeric_limits<float>::infinity());
    const Box box{{point.x - around, point.y - around, point.z - around},
                  {point.x + around, point.y + around, point.z + around}};
    double error = 0.0;
    static_cast<void>(for_each_candidate(scene, box, [&](InstanceId id) {
        error = std::max(error, measuring_error_at(scene, *instance_at(scene, {id.index}), point, distance));
    }));
    return error;
}

double distance_to_segment(const Vec3d& point, const Vec3d& from, const Vec3d& to) {
    const Vec3d way = to - from, offset = point - from;
    const double square = dot(way, way);
    const double t = square > 0.0 ? std::clamp(dot(offset, way) / square, 0.0, 1.0) : 0.0;
    return length_of(offset - t * way);
}

/// In float64, which has the products of a lattice's coordinates without rounding.
double distance_to_triangle(const Vec3d& point, const Triangle& triangle) {
    const Vec3d corners[] = {to_float64(triangle.a), to_float64(triangle.b), to_float64(triangle.c)};
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    double nearest = PointBox::infinity;
    bool is_beside = !(length_of(normal) > 0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& from = corners[i];
        const Vec3d& to = corners[(i + 1) % 3];
        nearest = std::min(nearest, distance_to_segment(point, from, to));
        is_beside |= dot(cross(to - from, point - from), normal) < 0.0;
    }
    return is_beside ? nearest : std::min(nearest, std::abs(dot(normal, point - corners[0])) / length_of(normal));
}

/// How far a place of the source is from the surface, and what that may be too large by.
struct Measured {
    double distance = PointBox::infinity;
    double error = 0.0;
};

/// The query finds the triangle, for the place as it rounds it; the distance is that of the place in float64.
Measured measure(const Blob& blob, const Vec3d& place) {
    const Vec3d point = place - blob.source_origin();
    const Vec3 in_blob = to_float32(point);
    const ClosestPoint nearest = closest_point(blob, in_blob);
    if (!nearest) return {};
    const auto distance_to = [&](TriangleId triangle) {
        return distance_to_triangle(point, triangle_at(blob, triangle).value);
    };
    const double rounded_by = length_of(point - to_float64(in_blob));
    const auto allowed = double(blob.max_error());
    Measured measured;
    measured.distance = distance_to(nearest.triangle);
    if (measured.distance > allowed) {  // another triangle may be nearer to the place than to where it was rounded
        const double radius = allowed + rounded_by + measuring_error_at(blob, in_blob, allowed);
        static_cast<void>(for_each_overlap(blob, Sphere{in_blob, to_float32(radius)}, [&](TriangleId triangle) {
            measured.distance = std::min(measured.distance, distance_to(triangle));
        }));
    }
    measured.error = std::ldexp(length_of(point) + measured.distance, -48);
    return measured;
}

Measured measure(const BakedScene& scene, const Vec3d& place) {
    const Vec3 point = to_float32(place);
    const auto distance = double(closest_point(scene, point)->distance);
    return {distance, measuring_error_at(scene, point, distance)};
}

template <class SourceSurface>
void check_point(const SourceSurface& surface, const Vec3d& place, const std::function<std::string()>& words,
                 SourceCheck& check) {
    const auto [distance, error] = measure(surface, place);
    ++check.checked;
    if (distance > double(surface.max_error()) + error) ++check.too_far;
    check.measuring_error = std::max(check.measuring_error, error);
    if (distance > check.worst_distance) {
        check.worst_distance = distance;
        check.worst = words();
    }
}

/// The places of the meshes; without a list of them each mesh is in place.
std::vector<ImportedPlace> places_of(const ImportResult& source) {
    if (!source.places.empty()) return source.places;
    std::vector<ImportedPlace> places;
    for (std::uint32_t i = 0; i < source.meshes.size(); ++i)
        places.push_back({i, source.meshes[i].file, source.meshes[i].mesh, {}});
    return places;
}

/// Measures source vertices, as the files have them in float64, against the surface: all of them up to a hundred
/// thousand or so, else every so many. Vertices that are not finite are left out: they were dropped or refused. Whether
/// anything of the source should be in a blob at all is left to the caller: triangles_with_area.
template <class SourceSurface>
SourceCheck check_source(const SourceSurface& surface, bool is_empty, const ImportResult& source) {
    SourceCheck check;
    std::vector<UsedVertices> used;
    for (const ImportedMesh& mesh : source.meshes) used.push_back(used_vertices(mesh));
    const std::vector<ImportedPlace> places = places_of(source);
    for (const ImportedPlace& place : places) {
        check.vertices += used[place.mesh].vertices.size();
        check.triangles_with_area += used[place.mesh].triangles_with_area;
    }
    if (is_empty) return check;
    const std::uint64_t stride = std::max<std::uint64_t>(1, (check.vertices + most_checked - 1) / most_checked);
    std::uint64_t next = 0;  // of the place's vertices
    for (const ImportedPlace& place : places) {
        const std::vector<std::uint32_t>& vertices = used[place.mesh].vertices;
        for (; next < vertices.size(); next += stride) {
            const std::uint32_t vertex = vertices[next];
            const auto words = [&] {
                const ImportedFile& file = source.files[place.file];
                return text(words_for_mesh(file, place.number, file.mesh_names[place.number]), ", vertex ", vertex);
            };
            check_point(surface, place.placement(source.meshes[place.mesh].positions[vertex]), words, check);
        }
        next -= vertices.size();
    }
    return check;
}

/// The checks that were chosen and their results; `failure` is empty as long as all pass.
struct Verification {
    OpenStatus status = OpenStatus::ok;
    bool deep = false;
    std::optional<SourceCheck> source;
    std::string failure;
};

float max_error_of(const AssetFile& file) { return file.is_a_scene ? file.scene().max_error() : file.blob.max_error(); }

std::string content_of(const AssetFile& file) {
    if (!file.is_a_scene) return counted(file.blob.triangle_count(), "triangle");
    const std::size_t meshes = file.scene().meshes().size(), tiles = file.scene().tiles().size();
    return text(counted(file.scene().instance_count(), "instance"), " of ", counted(meshes, "mesh"),
                tiles == 0 ? "" : text(" and ", counted(tiles, "tile")));
}

std::string source_failure(const AssetFile& file, const SourceCheck& check) {
    if (file.is_empty() && check.triangles_with_area > 0) {
        return text("the ", file.is_a_scene ? "scene" : "blob", " is empty, but the source has ",
                    counted(check.triangles_with_area, "triangle"), " with area. Is it this source?");
    }
    if (check.too_far == 0) return {};
    return text(check.too_far, " of ", counted(check.checked, "source vertex"),
                " lie farther from the baked surface than its max error ", shortest(max_error_of(file)),
                "; the farthest, at ", rounded(check.worst_distance), ": ", check.worst,
                ". Is it this source, with the --unit, --scale and --up that it was baked with?");
}

Json verification_json(const VerifyArguments& arguments, const Verification& result,
                       std::span<const Warning> warnings) {
    Json document = json_document();
    document["file"] = arguments.blob;
    document["ok"] = result.failure.empty();
    document["status"] = static_cast<int>(result.status);
    document["status_text"] = describe(result.status);
    document["deep"] = result.deep;
    if (result.source) {
        const SourceCheck& check = *result.source;
        document["source"] = {{"vertices", check.vertices}, {"checked", check.checked},
                              {"too_far", check.too_far},   {"worst_distance", check.worst_distance},
                              {"worst", check.worst},       {"measuring_error", check.measuring_error}};
    }
    document["warnings"] = warnings_json(warnings);
    document["failure"] = result.failure.empty() ? Json() : Json(result.failure);
    return document;
}

void print_result(const VerifyArguments& arguments, const AssetFile& file, const Verification& result) {
    std::cout << printable(arguments.blob) << ": ok, " << content_of(file) << '\n';
    std::cout << "  opened: every query on it is safe\n";
    if (result.deep) std::cout << "  deep: every box contains what is below it, and the header's counts are true\n";
    if (result.source) {
        std::cout << "  source: " << counted(result.source->checked, "vertex") << " of " << result.source->vertices
                  << " within max error " << shortest(max_error_of(file)) << ", farthest "
                  << rounded(result.source->worst_distance) << " (measured to "
                  << rounded(result.source->measuring_error, 2) << ")\n";
    }
    finish_standard_output();
}

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments, std::vector<Warning>& warnings) {
    ImportOptions options = import_options(arguments.source, arguments.json, warnings);
    Verification result;
    const AssetFile file(arguments.blob);
    result.status = file.status();
    ExitCode code = exit_code_of(result.status);
    if (result.status != OpenStatus::ok) result.failure = file.refusal();
    if (result.failure.empty() && arguments.deep) {
        result.deep = true;
        const VerifyReport report = file.is_a_scene ? verify_scene(file.bytes) : verify(file.bytes);
        if (!report) result.failure = text("'", printable(arguments.blob), "': ", report.message, ". Bake it again.");
    }
    if (result.failure.empty() && !arguments.sources.empty()) {
        options.keep_places = file.is_a_scene;
        const ImportResult source = import_or_throw(arguments.sources, options);
        if (!arguments.source.allow_empty) refuse_empty_files(source);
        if (arguments.source.strict) refuse_warnings(warnings, source);
        result.source = file.is_a_scene ? check_source(file.scene(), file.is_empty(), source)
                                        : check_source(file.blob, file.is_empty(), source);
        const std::string failure = source_failure(file, *result.source);
        if (!failure.empty()) result.failure = text("'", printable(arguments.blob), "': ", failure);
    }
    if (!result.failure.empty() && code == ExitCode::ok) code = ExitCode::invalid_input;
    Json document = arguments.json ? verification_json(arguments, result, warnings) : Json();
    if (!result.failure.empty()) {
        return report_failure({code, result.failure, {.file = arguments.blob}}, arguments.json ? &document : nullptr);
    }
    if (arguments.json) {
        print_json(document);
    } else {
        print_result(arguments, file, result);
    }
    return ExitCode::ok;
}

}  // namespace espalier::tools
