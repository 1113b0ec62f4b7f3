#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>

#include <import/base/numbers.hpp>
#include <import/base/placement.hpp>

#include "base/exit_code.hpp"
#include "base/vectors.hpp"
#include "measure.hpp"
#include "stored_triangles.hpp"

namespace espalier::tools {

namespace {

SourceCorners placed(const espalier::Transform& transform, SourceCorners corners) {
    for (Vec3d& corner : corners)
        corner = double(transform.scale) * turned(transform.rotation, corner) + to_float64(transform.translation);
    return corners;
}

/// Returns the least height of a triangle.
double height_of(const SourceCorners& corners) {
    const auto& [a, b, c] = corners;
    const double longest = std::max({length_of(b - a), length_of(c - b), length_of(a - c)});
    return longest > 0.0 ? length_of(cross(b - a, c - a)) / longest : 0.0;
}

/// The triangles of all instances, where their transforms place them. A scene does not keep the spaces in which its
/// meshes were baked, so triangles are found by their corners, and the rounding of the transforms counts.
class SceneTriangles final : public StoredTriangles {
public:
    explicit SceneTriangles(const BakedScene& scene) : scene_(scene) {
        std::size_t next = 0;
        for (std::uint32_t index = 0; index < scene.instance_count(); ++index) {
            begins_.emplace_back();
            for_each_mesh_at(index, [&](InstanceId id) {
                begins_.back().push_back(next);
                next += mesh_at(scene_, id)->triangle_count();
            });
        }
        has_source_.resize(next);
    }

    [[nodiscard]] std::uint64_t size() const override { return has_source_.size(); }

    Match match(const SourceCorners& in_source) override {
        const SourceCorners corners = from_origin(in_source);
        const Vec3d middle = middle_of(corners);
        const Vec3 point = to_float32(middle);
        const double tolerance = corner_tolerance(scene_.max_error());
        const double radius =
            tolerance + measuring_error_at(scene_, point, tolerance) + length_of(middle - to_float64(point));
        Match match = Match::none;
        const auto visit = [&](InstanceId id, TriangleId triangle) {
            const Instance instance = *instance_at(scene_, {id.index});
            double rounding = 0.0;
            for (const Vec3d& corner : corners)
                rounding = std::max(rounding, measuring_error_at(scene_, instance, to_float32(corner), tolerance));
            if (!are_corners_near(in_world(id, triangle), corners, tolerance + rounding)) return;
            const std::size_t at = place_of(id) + triangle.index;
            match = std::max(match, has_source_[at] ? Match::again : Match::first);
            has_source_[at] = true;
        };
        static_cast<void>(for_each_overlap(scene_, Sphere{point, to_float32(radius)}, visit));
        return match;
    }

    /// On its lattice each corner may have moved by max error, towards the opposite edge.
    [[nodiscard]] bool may_collapse(const SourceCorners& in_source) const override {
        const SourceCorners corners = from_origin(in_source);
        const auto max_error = static_cast<double>(scene_.max_error());
        return height_of(corners) <= 2.0 * (max_error + measuring_error_at(scene_, to_float32(corners[0]), max_error));
    }

    [[nodiscard]] Sourceless sourceless() const override {
        Sourceless result;
        for (std::uint32_t index = 0; index < scene_.instance_count(); ++index) {
            for_each_mesh_at(index, [&](InstanceId id) {
                const std::size_t begin = place_of(id);
                static_cast<void>(for_each_triangle(*mesh_at(scene_, id), [&](TriangleId triangle, const Triangle&) {
                    if (has_source_[begin + triangle.index] || result.count++ != 0) return;
                    result.first = text("triangle ", triangle.index, " of instance ", id.index,
                                        id.in_tile == no_instance.in_tile ? "" : text('.', id.in_tile));
                }));
            });
        }
        return result;
    }

private:
    /// Calls `visit` with the instance, or with each one in the tile that it is.
    template <class Visit>
    void for_each_mesh_at(std::uint32_t index, const Visit& visit) const {
        const std::uint32_t part = instance_at(scene_, {index})->mesh;
        const std::size_t meshes = scene_.meshes().size();
        if (part < meshes) return visit(InstanceId{index});
        const std::uint32_t count = scene_.tiles()[part - meshes].instance_count();
        for (std::uint32_t in_tile = 0; in_tile < count; ++in_tile) visit(InstanceId{index, in_tile});
    }

    [[nodiscard]] SourceCorners from_origin(const SourceCorners& corners) const {
        const Vec3d origin = scene_.source_origin();
        return {corners[0] - origin, corners[1] - origin, corners[2] - origin};
    }

    /// Returns the number of the first triangle of an instance.
    [[nodiscard]] std::size_t place_of(InstanceId id) const {
        return begins_[id.index][id.in_tile == no_instance.in_tile ? 0 : id.in_tile];
    }

    [[nodiscard]] SourceCorners in_world(InstanceId id, TriangleId triangle) const {
        const auto [a, b, c] = triangle_at(*mesh_at(scene_, id), triangle).value;
        SourceCorners corners{to_float64(a), to_float64(b), to_float64(c)};
        if (id.in_tile != no_instance.in_tile) corners = placed(instance_at(scene_, id)->transform, corners);
        return placed(instance_at(scene_, {id.index})->transform, corners);
    }

    const BakedScene& scene_;
    std::vector<std::vector<std::size_t>> begins_;  ///< of each instance, and of each one in a tile
    std::vector<bool> has_source_;
};

}  // namespace

std::unique_ptr<StoredTriangles> triangles_of_scene(const BakedScene& scene) {
    return std::make_unique<SceneTriangles>(scene);
}

}  // namespace espalier::tools
