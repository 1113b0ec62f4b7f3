// What a picture shows: a blob or a scene.
#pragma once

#include <functional>
#include <memory>

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

/// Return a view of a surface, which must outlive it.
[[nodiscard]] std::unique_ptr<Subject> subject_of(const Blob& blob);
[[nodiscard]] std::unique_ptr<Subject> subject_of(const BakedScene& scene);

}  // namespace espalier::tools
