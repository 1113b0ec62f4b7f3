#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include "stopwatch.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

// FCL answers collision and distance between shapes and has no ray, so that only its bytes and its build are compared.
// Bytes are the arrays that its queries read: nodes, vertices and triangles, of which it keeps its own copies; making
// them belongs to its build.
template <class Scalar>
class FclSystem final : public System {
public:
    explicit FclSystem(const Mesh& mesh) {
        std::vector<fcl::Vector3<Scalar>> positions;
        for (const Vec3& p : mesh.positions)
            positions.emplace_back(static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z));
        std::vector<fcl::Triangle> triangles;
        for (const TriangleVertices& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
        const Stopwatch watch;
        model_.beginModel(static_cast<int>(triangles.size()), static_cast<int>(positions.size()));
        model_.addSubModel(positions, triangles);
        model_.endModel();
        seconds_ = watch.seconds();
    }
    [[nodiscard]] std::size_t bytes() const override {
        return static_cast<std::size_t>(model_.getNumBVs()) * sizeof(fcl::BVNode<Volume>) +
               static_cast<std::size_t>(model_.num_vertices) * sizeof(fcl::Vector3<Scalar>) +
               static_cast<std::size_t>(model_.num_tris) * sizeof(fcl::Triangle);
    }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    [[nodiscard]] bool has_closest() const override { return false; }
    [[nodiscard]] bool has_any() const override { return false; }
    void closest(const std::vector<Ray>&, bool, std::vector<Hit>&) override {}
    void any(const std::vector<Ray>&, std::vector<std::uint8_t>&) override {}

private:
    using Volume = fcl::OBBRSS<Scalar>;
    fcl::BVHModel<Volume> model_;
    double seconds_ = 0.0;
};

}  // namespace

std::vector<Maker> fcl_makers() {
    return {
        {"fcl", "obbrss double", FCL_VERSION,
         [](const Mesh& mesh) { return std::make_unique<FclSystem<double>>(mesh); }},
        {"fcl", "obbrss float", FCL_VERSION, [](const Mesh& mesh) { return std::make_unique<FclSystem<float>>(mesh); }},
    };
}

}  // namespace espalier::bench
