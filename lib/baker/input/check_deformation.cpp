#include <baker/input/check_deformation.hpp>

#include <cmath>
#include <string>
#include <utility>

#include <baker/base/number_text.hpp>

namespace espalier::baker {

namespace {

/// "level.obj, mesh 3 (walls), vertex 17" of a position among those of all meshes.
std::string vertex_name(const Source& source, std::size_t position) {
    std::size_t mesh = 0;
    while (position >= source.meshes[mesh].position_count()) position -= source.meshes[mesh++].position_count();
    return mesh_name(source.meshes, mesh) + ", vertex " + std::to_string(position);
}

std::optional<Refusal> check_range(const Box& range) {
    if (find_not_finite(range.min) || find_not_finite(range.max))
        return invalid_options("the range of motion is not finite; choose two corners that are");
    const auto check = [&](const char* axis, float low, float high) -> std::optional<Refusal> {
        if (low <= high) return std::nullopt;
        return invalid_options(std::string("the range of motion goes from ") + number_text(double(low)) + " to " +
                               number_text(double(high)) + " on " + axis + "; give the low corner first");
    };
    if (auto refusal = check("x", range.min.x, range.max.x)) return refusal;
    if (auto refusal = check("y", range.min.y, range.max.y)) return refusal;
    return check("z", range.min.z, range.max.z);
}

}  // namespace

std::optional<Refusal> check_deformation(const BakeOptions& options) {
    if (!options.deformation) return std::nullopt;
    if (options.profile != Profile::fast)
        return invalid_options(
            "a deformable blob needs profile fast, whose leaves keep their size when vertices move; choose it");
    if (options.build.builder == Builder::spatial_splits)
        return invalid_options(
            "the builder spatial_splits clips triangles in one pose, which a deformable blob cannot keep; choose "
            "another builder");
    if (options.drop_bad_triangles)
        return invalid_options(
            "a deformable blob needs the positions of all vertices, so drop_bad_triangles is excluded; mend the mesh");
    if (options.flat_angle)
        return invalid_options(
            "edge flags describe one pose, and a deformable blob has many; leave flat_angle out, and use the normals "
            "of triangles");
    if (options.bounds.oriented_box || options.bounds.sphere || options.bounds.k_dop)
        return invalid_options("stored bounds describe one pose, and a deformable blob has many; leave bounds out");
    return options.deformation->range ? check_range(*options.deformation->range) : std::nullopt;
}

std::optional<Refusal> check_poses(const Source& source, const Deformation& deformation) {
    if (source.triangles.empty())
        return Refusal{
            BakeStatus::invalid_mesh,
            "there is no triangle to deform; give the meshes with their triangles, which poses alone may lack"};
    for (std::size_t i = 0; i < source.positions.size(); ++i) {
        if (const auto fault = find_not_finite(source.positions[i]))
            return Refusal{BakeStatus::invalid_mesh,
                           vertex_name(source, i) + " has " + *fault +
                               "; refit() takes the positions of all vertices, also of those without a triangle. Mend "
                               "the mesh"};
    }
    for (std::size_t pose = 0; pose < deformation.poses.size(); ++pose) {
        const std::string name = "pose " + std::to_string(pose + 1) + " of " + std::to_string(deformation.poses.size());
        const std::vector<Vec3>& positions = deformation.poses[pose];
        if (positions.size() != source.positions.size())
            return Refusal{BakeStatus::invalid_mesh, name + " has " + std::to_string(positions.size()) +
                                                         " positions, but the meshes have " +
                                                         std::to_string(source.positions.size()) +
                                                         "; give one for each vertex, in the order of the meshes"};
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (const auto fault = find_not_finite(positions[i]))
                return Refusal{BakeStatus::invalid_mesh, name + ", position " + std::to_string(i) + " has " + *fault +
                                                             "; mend the pose, or leave it out"};
        }
    }
    return std::nullopt;
}

}  // namespace espalier::baker
