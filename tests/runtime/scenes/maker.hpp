// Scenes for tests, and queries that are hard to answer over many instances.
#pragma once

#include "support/testing.hpp"

#include "support/loops/scene_loop.hpp"

namespace espalier::tests {

/// The bytes of a scene and the view that was opened on them. Throws when the baker or open_scene() refuses.
struct OpenedScene {
    explicit OpenedScene(std::vector<std::byte> scene_bytes);
    /// Instances number the tiles after the blobs.
    OpenedScene(const std::vector<OpenedBlob>& blobs, const std::vector<Instance>& instances,
                const std::vector<OpenedScene>& tiles = {});
    OpenedScene(OpenedScene&&) = default;
    OpenedScene& operator=(OpenedScene&&) = default;

    std::vector<std::byte> bytes;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    BakedScene scene;
};

/// Returns instances of a mesh side by side, so many along x and along z, from a place on.
std::vector<Instance> ground(int side, std::uint32_t mesh, float width, const Vec3& from = {});

/// A scene with a name, its meshes and tiles as they were baked, and its instances as they were given.
struct TestScene {
    std::string name;
    std::vector<OpenedBlob> blobs;
    std::vector<OpenedScene> tiles;
    std::vector<Instance> instances;
    OpenedScene opened;
};

/// Scenes of 0 to 200 instances: rotated, scaled, far from the origin, of coarse lattices, equal, nested, on one line,
/// near the least and the greatest numbers, of tiles.
const std::vector<TestScene>& test_scenes();

/// Shapes in the world near the instances of a scene.
class SceneQueryMaker {
public:
    SceneQueryMaker(const TestScene& scene, std::uint64_t seed);

    /// From anywhere around the scene or from far away, towards a vertex of an instance or anywhere in the scene.
    Ray ray();
    Sphere sphere();
    Capsule capsule();
    Box box();
    OrientedBox oriented_box();
    /// The vertices of a hull: 0 to 64 of them, some in one plane.
    std::vector<Vec3> hull_vertices();
    Triangle triangle();
    Cone cone();
    /// On, near or far from the surface of an instance.
    Vec3 point();
    Vec3 displacement();
    /// What a sweep ignores and the skin, with a filter. Every fourth ones are the default.
    SceneSweepOptions sweep_options(const SceneFilter& filter);
    [[nodiscard]] Random& random() { return random_; }

private:
    Vec3 anywhere();
    Vec3 on_surface();
    Vec3 on_surface_of(const Blob& mesh);
    float length();

    const TestScene& scene_;
    Random random_;
    Vec3 center_;
    float size_;
};

/// Fails if there is a difference. Returns 1 if something was found, to be counted.
inline std::size_t checked(const SceneComparison& comparison) {
    REQUIRE_MESSAGE(comparison.fault == nullptr, comparison.fault);
    return comparison.is_found ? 1u : 0u;
}

}  // namespace espalier::tests
