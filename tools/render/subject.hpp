// What a picture shows: a blob or a scene.
#pragma once

#include <cstdint>
#include <functional>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/scene.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

namespace espalier::tools {

/// A surface that rays meet. Any number of threads may call one.
class Subject {
public:
    virtual ~Subject() = default;

    [[nodiscard]] virtual RayHit closest_hit(const Ray& ray) const = 0;
    [[nodiscard]] virtual bool is_hit(const Ray& ray) const = 0;
    /// Returns a box around the surface; its middle is in the middle of the picture, about.
    [[nodiscard]] virtual Box bounds() const = 0;
    /// Returns the lattice step, the largest one if there are several.
    [[nodiscard]] virtual float step() const = 0;
    /// Calls `visit` with points whose hull contains the surface.
    virtual void for_each_corner(const std::function<void(Vec3)>& visit) const = 0;
};

class BlobSubject : public Subject {
public:
    explicit BlobSubject(const Blob& blob) : blob_(blob) {}

    [[nodiscard]] RayHit closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool is_hit(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] float step() const override;
    /// Visits the corners of all triangles.
    void for_each_corner(const std::function<void(Vec3)>& visit) const override;

private:
    const Blob& blob_;
};

class SceneSubject : public Subject {
public:
    explicit SceneSubject(const BakedScene& scene) : scene_(scene) {}

    [[nodiscard]] RayHit closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool is_hit(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] float step() const override;
    /// Visits the corners of the boxes of all instances.
    void for_each_corner(const std::function<void(Vec3)>& visit) const override;

private:
    const BakedScene& scene_;
};

}  // namespace espalier::tools
