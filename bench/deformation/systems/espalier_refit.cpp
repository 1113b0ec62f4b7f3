#include <algorithm>

#include "../deformable_mesh.hpp"
#include "../refit_system.hpp"

namespace espalier::bench {
namespace {

class EspalierRefit final : public RefitSystem {
public:
    EspalierRefit(const Mesh& mesh, const Box& range, unsigned bits)
        : mesh_(mesh, {.range = range, .bits = bits}), positions_(mesh.positions) {}
    void set_positions(const std::vector<Vec3>& positions) override {
        std::copy(positions.begin(), positions.end(), positions_.begin());
    }
    void refit() override { mesh_.move(positions_); }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        return is_within(point, mesh_.blob().bounds(), rounding);
    }
    /// The positions are the caller's: queries read the blob alone.
    [[nodiscard]] std::size_t bytes() const override {
        return mesh_.work().moving_bytes + mesh_.work().source_bytes + mesh_.work().still_bytes;
    }
    [[nodiscard]] std::optional<RefitWork> work() const override { return mesh_.work(); }

private:
    DeformableMesh mesh_;
    std::vector<Vec3> positions_;
};

}  // namespace

RefitMakers espalier_refit_makers(unsigned bits) {
    return {
        {"espalier", std::to_string(bits) + " bits", ESPALIER_BENCH_VERSION,
         [bits](const Mesh& mesh, const Box& range) { return std::make_unique<EspalierRefit>(mesh, range, bits); }}};
}

}  // namespace espalier::bench
