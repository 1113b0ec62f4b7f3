// tinybvh's fastest structure for rays on a processor with AVX2. Compiled with AVX2 and FMA, as its header requires.
#define TINYBVH_IMPLEMENTATION
#include <tiny_bvh.h>

#include "system.hpp"

namespace espalier::bench {
namespace {

// Its leaves hold copies of the triangles, so that queries read its blocks alone. What only the build reads is kept by
// the structure and not counted.
class TinybvhSystem final : public System {
public:
    TinybvhSystem(const Mesh& mesh, bool splits) : mesh_(mesh) {
        for (const Vec3& p : mesh.positions) positions_.emplace_back(p.x, p.y, p.z, 0.0f);
        const auto* corners = mesh.triangles.data()->data();
        const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
        const Stopwatch watch;
        if (splits) tree_.BuildHQ(positions_.data(), corners, triangles);
        else tree_.Build(positions_.data(), corners, triangles);
        seconds_ = watch.seconds();
    }
    [[nodiscard]] std::size_t bytes() const override { return std::size_t{tree_.usedBlocks} * 64; }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            tinybvh::Ray query = to_query(rays[i]);
            tree_.Intersect(query);
            hits[i].found = query.hit.t < BVH_FAR;
            if (!hits[i].found) continue;
            const TriangleVertices& t = mesh_.triangles[query.hit.prim];
            const Vec3 a = mesh_.positions[t[0]];
            const Vec3 normal =
                tests::cross(tests::difference(mesh_.positions[t[1]], a), tests::difference(mesh_.positions[t[2]], a));
            hits[i] = {true, query.hit.t, query.hit.u, query.hit.v, normal, query.hit.prim};
        }
    }
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = tree_.IsOccluded(to_query(rays[i]));
    }

private:
    // Rays have length 1, which its constructor would make them.
    static tinybvh::Ray to_query(const Ray& ray) {
        return {{ray.origin.x, ray.origin.y, ray.origin.z}, {ray.direction.x, ray.direction.y, ray.direction.z}};
    }
    const Mesh& mesh_;
    std::vector<tinybvh::bvhvec4> positions_;
    tinybvh::BVH8_CPU tree_;
    double seconds_ = 0.0;
};

}  // namespace

std::vector<Maker> tinybvh_makers() {
    const std::string version = std::to_string(TINY_BVH_VERSION_MAJOR) + "." + std::to_string(TINY_BVH_VERSION_MINOR) +
                                "." + std::to_string(TINY_BVH_VERSION_SUB);
    std::vector<Maker> makers;
    for (const bool splits : {false, true})
        makers.push_back({"tinybvh", splits ? "BVH8_CPU, spatial splits" : "BVH8_CPU", version,
                          [splits](const Mesh& mesh) { return std::make_unique<TinybvhSystem>(mesh, splits); }});
    return makers;
}

}  // namespace espalier::bench
