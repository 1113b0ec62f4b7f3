// Scenes for tests, and queries that are hard to answer over many instances.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

/// The bytes of a scene and the view that was opened on them. Throws when the baker or open_scene() refuses.
struct OpenedScene {
    explicit OpenedScene(std::vector<std::byte> scene_bytes);
    /// Instances number the tiles after the blobs.
    OpenedScene(const std::vector<OpenedBlob>& blobs, const std::vector<Instance>& instances,
                const std::vector<OpenedScene>& tiles = {});
    OpenedScene(OpenedScene&&) = default;
    OpenedScene& operator=(OpenedScene&&) = default;
    OpenedScene(const OpenedScene&) = delete;
    OpenedScene& operator=(const OpenedScene&) = delete;
    ~OpenedScene() = default;

    std::vector<std::byte> bytes;
    std::vector<Blob> meshes;
    std::vector<BakedScene> tiles;
    BakedScene scene;
};

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
    /// Calls add(shape) with a shape of each kind that sweeps take.
    template <class Add>
    void make_swept_shapes(const Add& add) {
        add(sphere());
        add(capsule());
        add(box());
        add(oriented_box());
        const std::vector<Vec3> vertices = hull_vertices();
        add(ConvexHull{vertices});
    }
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

}  // namespace espalier::tests
