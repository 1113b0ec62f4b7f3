#include "source_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <espalier/distance.hpp>

#include "base/numbers.hpp"
#include "base/placement.hpp"

namespace espalier::tools {

namespace {

constexpr std::uint64_t most_checked = 100'000;

std::array<double, 3> difference(Vec3 to, Vec3 from) {
    const auto along = [](float a, float b) { return static_cast<double>(a) - static_cast<double>(b); };
    return {along(to.x, from.x), along(to.y, from.y), along(to.z, from.z)};
}

bool has_area(Vec3 a, Vec3 b, Vec3 c) {
    const std::array<double, 3> u = difference(b, a);
    const std::array<double, 3> v = difference(c, a);
    return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

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
    const std::array<double, 3> offset = difference(point, {origin[0], origin[1], origin[2]});
    const double reach = std::max({std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
    const int finer_by = std::clamp(23 - static_cast<int>(detail::data_of(blob).bits), 0, 6);
    const double on_each_axis = std::ldexp(1.0, blob.lattice().step_exponent - finer_by - 1) + std::ldexp(reach, -24);
    return std::sqrt(3.0) * on_each_axis + std::ldexp(distance, -21);
}

double distance_to(const Blob& blob, Vec3 point) { return static_cast<double>(closest_point(blob, point).distance); }

double distance_to(const BakedScene& scene, Vec3 point) {
    return static_cast<double>(closest_point(scene, point)->distance);
}

double measuring_error_at(const BakedScene& scene, Vec3 point, double distance);

/// The same for an instance. Its transform and its vertices were rounded to float32 when it was baked, and the point
/// when it was placed; to_local() rounds that, the blob again, and the result when it returns to the world.
double measuring_error_at(const BakedScene& scene, const Instance& instance, Vec3 point, double distance) {
    const Transform& transform = instance.transform;
    const auto scale = static_cast<double>(transform.scale);
    const std::array<double, 3> offset = difference(point, transform.translation);
    const double reach = std::hypot(offset[0], offset[1], offset[2]);
    const Vec3& moved = transform.translation;
    const double translation =
        std::hypot(static_cast<double>(moved.x), static_cast<double>(moved.y), static_cast<double>(moved.z));
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

template <class SourceSurface>
void check_point(const SourceSurface& surface, Vec3 point, const std::function<std::string()>& words,
                 SourceCheck& check) {
    const double distance = distance_to(surface, point);
    const double error = measuring_error_at(surface, point, distance);
    ++check.checked;
    if (distance > static_cast<double>(surface.max_error()) + error) ++check.too_far;
    check.measuring_error = std::max(check.measuring_error, error);
    if (distance > check.worst_distance) {
        check.worst_distance = distance;
        check.worst = words();
    }
}

/// The places of the meshes; without a list of them each mesh is in place.
std::vector<ImportedPlace> places_of(const Imported& source) {
    if (!source.places.empty()) return source.places;
    std::vector<ImportedPlace> places;
    for (std::uint32_t i = 0; i < source.meshes.size(); ++i)
        places.push_back({i, source.meshes[i].file, source.meshes[i].mesh, {}});
    return places;
}

template <class SourceSurface>
SourceCheck check_surface(const SourceSurface& surface, bool is_empty, const Imported& source) {
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

}  // namespace

SourceCheck check_source(const Blob& blob, const Imported& source) {
    return check_surface(blob, blob.triangle_count() == 0, source);
}

SourceCheck check_source(const BakedScene& scene, const Imported& source) {
    return check_surface(scene, scene.instance_count() == 0, source);
}

}  // namespace espalier::tools
