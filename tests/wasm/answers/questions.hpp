// The questions, and what answers them: each function adds the answers of its queries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

namespace espalier::answers {

struct Questions {
    std::vector<Vec3> origins;
    std::vector<Vec3> directions;
    std::vector<float> limits;
    std::vector<float> radii;
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> vertex_offsets;
    std::vector<Plane> planes;
    std::vector<std::uint32_t> plane_offsets;

    [[nodiscard]] std::size_t count() const { return origins.size(); }
    [[nodiscard]] Ray ray(std::size_t i, FaceCulling culling) const {
        return {origins[i], directions[i], 0.05f, limits[i], culling};
    }
    [[nodiscard]] Transform place(std::size_t i) const {
        return {{directions[i].x, directions[i].y, directions[i].z, limits[i]}, origins[i], radii[i]};
    }
    [[nodiscard]] Sphere sphere(std::size_t i) const { return {origins[i], radii[i]}; }
    [[nodiscard]] Capsule capsule(std::size_t i) const { return {origins[i], directions[i], radii[i]}; }
    [[nodiscard]] Box box(std::size_t i) const { return {origins[i], directions[i]}; }
    [[nodiscard]] OrientedBox oriented_box(std::size_t i) const {
        return {origins[i], {directions[i], next_direction(i), {0.0f, 0.0f, radii[i]}}};
    }
    [[nodiscard]] ConvexHull hull(std::size_t i) const { return {part(vertices, vertex_offsets, i)}; }
    [[nodiscard]] ConvexVolume volume(std::size_t i) const { return {part(planes, plane_offsets, i)}; }

    /// Calls with the name of each volume that scenes take, and with the volume.
    template <class Call>
    void for_each_volume(std::size_t i, const Call& call) const {
        call("sphere", sphere(i));
        call("capsule", capsule(i));
        call("box", box(i));
        call("oriented_box", oriented_box(i));
        call("cone", Cone{origins[i], directions[i], radii[i]});
        call("triangle", Triangle{origins[i], directions[i], next_direction(i)});
    }
    /// The same for bodies that move.
    template <class Call>
    void for_each_body(std::size_t i, const Call& call) const {
        call("sweep_sphere", sphere(i));
        call("sweep_capsule", capsule(i));
        call("sweep_box", box(i));
        call("sweep_oriented_box", oriented_box(i));
        call("sweep_convex_hull", hull(i));
    }

private:
    [[nodiscard]] const Vec3& next_direction(std::size_t i) const { return directions[(i + 1) % count()]; }
    template <class Part>
    static std::span<const Part> part(const std::vector<Part>& all, const std::vector<std::uint32_t>& offsets,
                                      std::size_t i) {
        return std::span(all).subspan(offsets[i], offsets[i + 1] - offsets[i]);
    }
};

/// Answers for one blob, and for the triangles of every third number but one.
void answer_blob(const Blob& blob, const Questions& questions);
/// Answers for a blob at one place, and another one at each.
void answer_pairs(const Blob& a, const Blob& b, const Questions& questions);
/// Returns instances of two blobs at the places of some questions.
std::vector<Instance> instances_of(const Questions& questions);
void answer_scene(const BakedScene& scene, const Questions& questions);
/// Answers for a moving scene of two blobs and a tile, after some changes, and for its pairs. Returns its bytes.
std::vector<std::byte> answer_moving(const Blob& blob, const Blob& coarse, const BakedScene& tile,
                                     const Questions& questions);

}  // namespace espalier::answers
