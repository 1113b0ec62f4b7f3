// The questions, and what answers them: each function writes the files of its queries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

/// The shapes of one question.
struct Shapes {
    espalier::Sphere sphere;
    espalier::Capsule capsule;
    espalier::Box box;
    espalier::OrientedBox oriented_box;
    espalier::Cone cone;
    espalier::Triangle triangle;
};

struct Questions {
    std::vector<espalier::Vec3> origins;
    std::vector<espalier::Vec3> directions;
    std::vector<float> limits;
    std::vector<float> radii;
    std::vector<espalier::Vec3> vertices;
    std::vector<std::uint32_t> vertex_offsets;
    std::vector<espalier::Plane> planes;
    std::vector<std::uint32_t> plane_offsets;

    [[nodiscard]] espalier::Ray ray(std::size_t i) const {
        return {origins[i], directions[i], 0.05f, limits[i], static_cast<espalier::FaceCulling>(i % 3)};
    }
    [[nodiscard]] espalier::Transform place(std::size_t i) const {
        return {{directions[i].x, directions[i].y, directions[i].z, limits[i]}, origins[i], radii[i]};
    }
    [[nodiscard]] Shapes shapes(std::size_t i) const {
        const espalier::Vec3 a = origins[i];
        const espalier::Vec3 b = directions[i];
        const espalier::Vec3 c = directions[(i + 1) % directions.size()];
        const float radius = radii[i];
        return {{a, radius}, {a, b, radius}, {a, b}, {a, {b, c, {0.0f, 0.0f, radius}}}, {a, b, radius}, {a, b, c}};
    }
    [[nodiscard]] espalier::ConvexHull hull(std::size_t i) const { return {part(vertices, vertex_offsets, i)}; }
    [[nodiscard]] espalier::ConvexVolume volume(std::size_t i) const { return {part(planes, plane_offsets, i)}; }

private:
    template <class Part>
    static std::span<const Part> part(const std::vector<Part>& all, const std::vector<std::uint32_t>& offsets,
                                      std::size_t i) {
        return std::span(all).subspan(offsets[i], offsets[i + 1] - offsets[i]);
    }
};

void answer_blob(const espalier::Blob& blob, const Questions& questions);
/// Answers for the triangles of every third number but one.
void answer_filtered(const espalier::Blob& blob, const Questions& questions);
/// Answers for a blob at one place, and another one at each.
void answer_pairs(const espalier::Blob& a, const espalier::Blob& b, const Questions& questions);
/// Returns instances of two blobs at the places of some questions.
std::vector<espalier::Instance> instances_of(const Questions& questions);
void answer_scene(const espalier::BakedScene& scene, const Questions& questions);
/// Answers for a moving scene of two blobs and a tile, after some changes, and for its pairs.
void answer_moving(const espalier::Blob& blob, const espalier::Blob& coarse, const espalier::BakedScene& tile,
                   const Questions& questions);
