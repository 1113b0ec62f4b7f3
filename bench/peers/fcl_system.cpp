#include "fcl.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

// FCL answers collision and distance between shapes and has no ray, so that only its bytes and its build are compared.
// It keeps its own copies of vertices and triangles; making them belongs to its build.
template <class Scalar>
class FclSystem final : public System {
public:
    explicit FclSystem(const Mesh& mesh) {
        const FclArrays<Volume> arrays(mesh);
        const Stopwatch watch;
        arrays.build(model_);
        seconds_ = watch.seconds();
    }
    [[nodiscard]] std::size_t bytes() const override { return bytes_of(model_); }
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
