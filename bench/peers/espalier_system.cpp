#include "../../tools/base/choices.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

class EspalierSystem : public System {
public:
    EspalierSystem(const Mesh& mesh, const BakeOptions& options) : mesh_(mesh), options_(options) {
        const Stopwatch watch;
        BakeResult baked = bake_or_throw(options);
        seconds_ = watch.seconds();
        lattice_ = {baked.report.lattice.step, baked.report.bounds.extent, baked.report.lattice.max_error};
        bytes_ = std::move(baked.bytes);
        blob_ = open(bytes_);
        if (!blob_) throw std::runtime_error(mesh.name + ": what was baked does not open: " + describe(blob_.status()));
    }
    /// The whole blob, header included.
    [[nodiscard]] std::size_t bytes() const override { return bytes_.size(); }
    /// The whole of bake(), its check of its own result included.
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayHit hit = raycast(blob_, rays[i]);
            hits[i].found = bool(hit);
            if (hit) hits[i] = to_hit(hit);
        }
    }
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = occluded(blob_, rays[i]).yes();
    }
    [[nodiscard]] std::optional<Lattice> lattice() const override { return lattice_; }
    [[nodiscard]] std::optional<std::size_t> bytes_at_20_bits() const override {
        BakeOptions options = options_;
        options.resolution = Resolution::bits(20);
        return bake_or_throw(options).bytes.size();
    }
    [[nodiscard]] std::size_t bytes_with_ids() const override {
        BakeOptions options = options_;
        options.original_ids = true;
        return bake_or_throw(options).bytes.size();
    }

protected:
    static Hit to_hit(const RayHit& hit) { return {true, hit.t, hit.u, hit.v, hit.normal, hit.triangle.index}; }
    [[nodiscard]] const Blob& blob() const { return blob_; }

private:
    [[nodiscard]] BakeResult bake_or_throw(const BakeOptions& options) const {
        const MeshView view = mesh_.view();
        auto baked = bake({&view, 1}, options);
        if (!baked) throw std::runtime_error(baked.message);
        return baked;
    }
    const Mesh& mesh_;
    BakeOptions options_;
    std::vector<std::byte> bytes_;
    Blob blob_;
    Lattice lattice_;
    double seconds_ = 0.0;
};

/// Asked for many rays in one call, while peers are asked ray by ray; copying the answers into the form that is asked
/// of everybody is in the time.
class EspalierBatchSystem final : public EspalierSystem {
public:
    using EspalierSystem::EspalierSystem;
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        std::array<RayHit, 512> found;
        for (std::size_t first = 0; first < rays.size(); first += found.size()) {
            const std::size_t count = std::min(found.size(), rays.size() - first);
            static_cast<void>(raycast(blob(), std::span(rays).subspan(first, count), std::span(found).first(count)));
            for (std::size_t i = 0; i < count; ++i) hits[first + i] = found[i] ? to_hit(found[i]) : Hit{};
        }
    }
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        std::array<YesNo, 512> found;
        for (std::size_t first = 0; first < rays.size(); first += found.size()) {
            const std::size_t count = std::min(found.size(), rays.size() - first);
            static_cast<void>(occluded(blob(), std::span(rays).subspan(first, count), std::span(found).first(count)));
            for (std::size_t i = 0; i < count; ++i) answers[first + i] = found[i].yes();
        }
    }
};

}  // namespace

std::vector<Maker> espalier_makers(const BakeSettings& settings) {
    std::vector<Maker> makers;
    for (const auto& [name, profile] : tools::profile_choices) {
        const BakeOptions options = {.resolution = Resolution::bits(settings.bits),
                                     .profile = profile,
                                     .effort = settings.effort,
                                     .build = {.builder = settings.builder}};
        makers.push_back({"espalier", name, ESPALIER_BENCH_VERSION,
                          [options](const Mesh& mesh) { return std::make_unique<EspalierSystem>(mesh, options); }});
        makers.push_back(
            {"espalier", std::string(name) + "/batch", ESPALIER_BENCH_VERSION,
             [options](const Mesh& mesh) { return std::make_unique<EspalierBatchSystem>(mesh, options); }});
    }
    return makers;
}

}  // namespace espalier::bench
