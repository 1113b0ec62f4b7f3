// The interface of a system that is measured: built on one mesh, then queried with many rays.
#pragma once

#include "../../tests/support/base/vectors.hpp"
#include "../base.hpp"

namespace espalier::bench {

/// The result of a ray, the same for every system. A value that a system does not return is computed from its result
/// within the measured time.
struct Hit {
    bool found = false;
    float t = 0.0f, u = 0.0f, v = 0.0f;
    Vec3 normal;
    std::uint32_t id = 0;
};

/// What rounding the vertices cost, in the units of the mesh that was built.
struct Lattice {
    double step = 0.0;
    double extent = 0.0;  ///< largest side of the box
    double max_error = 0.0;
};

class System {
public:
    System() = default;
    System(const System&) = delete;
    System& operator=(const System&) = delete;
    virtual ~System() = default;
    /// Everything that a query reads: tree, vertices, indices. Each system's file says how it is counted.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
    /// From arrays of vertices and indices to an answering structure; copying them into the system's own is left out
    /// where the system lets us.
    [[nodiscard]] virtual double build_seconds() const = 0;
    /// False: there is no such query, and it is never called.
    [[nodiscard]] virtual bool has_closest() const { return true; }
    [[nodiscard]] virtual bool has_any() const { return true; }
    /// `coherent`: neighbouring rays are alike, and the system may be told so.
    virtual void closest(const std::vector<Ray>& rays, bool coherent, std::vector<Hit>& hits) = 0;
    /// 1 for a ray that hits anything, else 0.
    virtual void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) = 0;
    /// Nothing for a system that keeps float32 vertices.
    [[nodiscard]] virtual std::optional<Lattice> lattice() const { return std::nullopt; }
    /// The same at 20 lattice bits; builds again.
    [[nodiscard]] virtual std::optional<std::size_t> bytes_at_20_bits() const { return std::nullopt; }
    /// The same when a hit must name the source's triangle; builds again where that is an option.
    [[nodiscard]] virtual std::size_t bytes_with_ids() const { return bytes(); }
};

/// How to make one; `mesh` must outlive what is made.
struct Maker {
    std::string name;
    std::string profile;
    std::string version;
    std::function<std::unique_ptr<System>(const Mesh& mesh)> make;
};

/// What Espalier is baked with.
struct BakeSettings {
    unsigned bits = 16;
    Effort effort = Effort::normal;
    Builder builder = Builder::binned_sah;
};

// Each in a file of its own, which is compiled where the system is installed.
std::vector<Maker> espalier_makers(const BakeSettings& settings);
std::vector<Maker> embree_makers();  ///< the reference first
std::vector<Maker> bullet_makers();
std::vector<Maker> ode_makers();
std::vector<Maker> fcl_makers();
std::vector<Maker> embree4_makers();
std::vector<Maker> jolt_makers();
std::vector<Maker> box3d_makers();
std::vector<Maker> tinybvh_makers();

/// All that this build knows, in the order in which they take turns: the reference and Espalier next to each other.
std::vector<Maker> all_makers(const BakeSettings& settings);

/// Whether ratios are taken to this one.
bool is_reference(const Maker& maker);

// What some peers leave to their caller.

inline Vec3 along(const Ray& ray, float t) {
    return {ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y, ray.origin.z + t * ray.direction.z};
}

/// A finite end for rays without one, for systems that cast segments: past the far side of `sphere`, times the length
/// of the direction. Tight, because such systems visit every box on the whole segment.
inline float reach(const Ray& ray, const BoundingSphere& sphere) {
    const Vec3 to_center = tests::difference(sphere.center, ray.origin);
    const float length = std::sqrt(tests::dot(ray.direction, ray.direction));
    const float distance = std::sqrt(tests::dot(to_center, to_center)) + 1.01f * sphere.radius;
    return std::min(ray.t_max, distance / length);
}

/// Weights of the second and the third corner at `point` of the plane (Ericson, Real-Time Collision Detection, 2005,
/// section 3.4: by Cramer's rule).
inline void set_barycentric(const Mesh& mesh, std::uint32_t triangle, Vec3 point, Hit& hit) {
    const TriangleVertices& corners = mesh.triangles[triangle];
    const Vec3 a = mesh.positions[corners[0]];
    const Vec3 ab = tests::difference(mesh.positions[corners[1]], a);
    const Vec3 ac = tests::difference(mesh.positions[corners[2]], a);
    const Vec3 ap = tests::difference(point, a);
    const float bb = tests::dot(ab, ab), bc = tests::dot(ab, ac), cc = tests::dot(ac, ac), pb = tests::dot(ap, ab),
                pc = tests::dot(ap, ac);
    const float inverse = 1.0f / (bb * cc - bc * bc);
    hit.u = (cc * pb - bc * pc) * inverse;
    hit.v = (bb * pc - bc * pb) * inverse;
}

}  // namespace espalier::bench
