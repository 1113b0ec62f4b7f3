// The C++ side of asking.h: the same questions in the same order, asked of the C++ functions.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/scene.hpp>

#include "asking.h"

namespace espalier::tests {

inline Vec3 cpp(espalier_vec3 v) { return {v.x, v.y, v.z}; }

inline LatticePoint bits_of(espalier_vec3 v) {
    return {std::bit_cast<std::int32_t>(v.x), std::bit_cast<std::int32_t>(v.y), std::bit_cast<std::int32_t>(v.z)};
}

class Expecting {
public:
    Expecting(const Blob& blob, const Blob& other, const BakedScene& scene, MovingScene& moving, const question& asked)
        : blob_(blob), other_(other), scene_(scene), moving_(moving), asked_(asked) {}

    void lookups();
    void rays();
    void volumes();
    void points();
    void batches();
    void sweeps();
    void pairs();
    void transforms();
    void approximations();
    void walks();
    void steps();
    void nothing();
    void scenes();
    void nothing_of_scenes();
    void changes();
    void moving_scenes();
    void scene_pairs();

    /// Chooses the mesh and the positions of refits().
    Expecting& with(Deformable& mesh, std::span<const Vec3> positions) {
        mesh_ = &mesh;
        positions_ = positions;
        return *this;
    }
    void refits();

    [[nodiscard]] const std::vector<std::uint32_t>& words() const { return words_; }

private:
    void tell(std::uint32_t word) { words_.push_back(word); }
    void tell(bool yes) { words_.push_back(yes ? 1 : 0); }
    void tell(float number) { words_.push_back(std::bit_cast<std::uint32_t>(number)); }
    void tell(std::uint64_t number) { words_.push_back(static_cast<std::uint32_t>(number)); }
    void tell(Vec3 v) {
        tell(v.x);
        tell(v.y);
        tell(v.z);
    }
    void tell(TriangleId triangle) { tell(triangle.index); }
    template <class Enumeration>
    requires std::is_enum_v<Enumeration>
    void tell(Enumeration value) { tell(static_cast<std::uint32_t>(value)); }

    void tell(YesNo answer) { tell(answer.status()); }
    void tell(const RayHit& hit);
    void tell(const OriginalHit& original);
    void tell(const ClosestPoint& nearest);
    void tell(const SweepHit& hit);
    void tell(const PairContact& contact);
    void tell(const PairTouch& touch);
    void tell(const BlobDistance& nearest);
    void tell(const Segment& segment);
    void tell(const Capsule& capsule);
    void tell(const OrientedBox& box);
    void tell(const Ray& ray);
    void tell(const Transform& transform);
    void tell(const QueryCounters& counters);
    void tell(const LatticePoint& steps);
    void tell(const LatticeHit& hit);
    void tell(const Lattice& lattice);
    void tell(const Filled& filled);
    void tell(const Result<OriginalTriangle>& original);
    void about(TriangleId triangle);
    void one_ray(const Ray& ray);
    void originals(const std::array<RayHit, 18>& hits);
    void rounded_ray(const Lattice& region, const Ray& ray);
    template <class Shape>
    void volume(const Shape& shape);
    template <class Shape>
    void moving(const Shape& shape);
    void placed(const Transform& own_placement, const Transform& placement, WorkLimit limit);
    void placing(const Transform& transform);
    template <class Hit>
    void tell(const InScene<Hit>& found);
    void tell(InstanceId id);
    void tell(const Result<Instance>& instance);
    void instance(InstanceId id);
    void scene_itself();
    /// The queries of a BakedScene or a MovingScene.
    template <class Scene>
    void queries_of(const Scene& scene);
    template <class Scene>
    void rays_in(const Scene& scene, const SceneFilter& filter);
    template <class Scene>
    void shapes_in(const Scene& scene, const SceneFilter& filter);
    template <class Scene, class Shape>
    void shape_in(const Scene& scene, const Shape& shape, const SceneFilter& filter);
    template <class Scene, class Shape>
    void sweep_in(const Scene& scene, const Shape& shape, const SceneFilter& filter);
    void tell(const Result<InstanceHandle>& handle);
    InstanceHandle some_handle(std::uint32_t bits);
    [[nodiscard]] Transform some_transform(int i) const;
    void about_instance(InstanceHandle handle);
    void moving_scene_itself();
    void pages(const PairFilter& filter);
    void pages_with_baked(const PairFilter& filter);
    template <class Pair, std::size_t size>
    void tell(const FilledPairs<Pair>& page, const std::array<Pair, size>& pairs);
    void tell(const InstancePair& pair);
    void tell(const BakedPair& pair);
    void tell(const RefitResult& result);
    void mesh_itself();

    [[nodiscard]] Vec3 point(int i) const { return cpp(asked_.points[i]); }
    [[nodiscard]] Vec3 direction(int i) const { return cpp(asked_.directions[i]); }
    [[nodiscard]] float length(int i) const { return asked_.lengths[i]; }
    [[nodiscard]] Segment segment() const { return {point(0), point(1)}; }
    [[nodiscard]] Sphere sphere() const { return {point(0), length(0)}; }
    [[nodiscard]] Capsule capsule() const { return {point(1), point(2), length(1)}; }
    [[nodiscard]] Box box() const { return {point(0), point(3)}; }
    [[nodiscard]] OrientedBox oriented_box() const { return {point(1), {direction(0), direction(1), direction(2)}}; }
    [[nodiscard]] std::array<Vec3, 4> all_points() const { return {point(0), point(1), point(2), point(3)}; }
    [[nodiscard]] ConvexHull convex_hull(const std::array<Vec3, 4>& vertices) const {
        return {std::span(vertices).first(asked_.bits % 5)};
    }
    [[nodiscard]] Cone cone() const { return {point(2), direction(0), length(2)}; }
    [[nodiscard]] Triangle triangle() const { return {point(0), point(1), point(2)}; }
    template <std::size_t count>
    [[nodiscard]] std::array<Ray, count> made_rays() const {
        std::array<Ray, count> rays;
        rays[0] = {point(0), direction(0)};
        rays[1] = {point(0), direction(0), length(0), length(1), static_cast<FaceCulling>(asked_.bits % 4)};
        rays[2] = Ray::between(point(0), point(1));
        for (std::size_t i = 3; i < count; ++i) {
            rays[i] = rays[i % 3];
            rays[i].origin = point(static_cast<int>(i % 4));
        }
        return rays;
    }
    [[nodiscard]] bool counts(TriangleId triangle) const { return (triangle.index + asked_.bits) % 2 == 0; }
    Visit visit_triangle(TriangleId triangle, const Triangle& corners) {
        tell(triangle);
        tell(corners.a);
        tell(corners.b);
        tell(corners.c);
        return visit_one();
    }
    Visit visit_one() {
        if (visits_ == 0) return Visit::stop;
        --visits_;
        return Visit::next;
    }

    const Blob& blob_;
    const Blob& other_;
    const BakedScene& scene_;
    MovingScene& moving_;
    const question& asked_;
    Deformable* mesh_ = nullptr;
    std::span<const Vec3> positions_;
    std::uint32_t visits_ = 0;
    std::vector<std::uint32_t> words_;
};

}  // namespace espalier::tests
