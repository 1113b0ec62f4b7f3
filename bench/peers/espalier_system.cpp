#include <cstdio>
#include <cstdlib>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "system.hpp"

namespace espalier::bench {
namespace {

class EspalierSystem final : public System {
public:
    EspalierSystem(const Mesh& mesh, unsigned bits, unsigned effort) {
        BakeOptions options;
        options.bits = bits;
        options.effort = effort;
        const MeshView view = mesh.view();
        auto baked = bake({&view, 1}, options);
        if (!baked) fail(baked.error().message.c_str());
        seconds_ = baked->report.seconds;
        bytes_ = std::move(baked->blob);
        if (const Status status = open(bytes_, blob_); status != Status::ok) fail(describe(status));
    }
    [[nodiscard]] const char* name() const override { return "espalier"; }
    [[nodiscard]] const char* profile() const override { return "fast"; }
    [[nodiscard]] std::size_t bytes() const override { return bytes_.size(); }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool, std::vector<Hit>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RayHit hit;
            hits[i].found = raycast(blob_, rays[i], hit);
            if (hits[i].found) hits[i] = {true, hit.t, hit.u, hit.v, hit.normal, hit.triangle.index};
        }
    }
    std::size_t any(const std::vector<Ray>& rays) override {
        std::size_t count = 0;
        for (const Ray& ray : rays) count += occluded(blob_, ray);
        return count;
    }

private:
    [[noreturn]] static void fail(const char* why) {
        std::fprintf(stderr, "espalier: %s\n", why);
        std::exit(3);
    }
    std::vector<std::byte> bytes_;
    Blob blob_;
    double seconds_ = 0.0;
};

}  // namespace

std::unique_ptr<System> make_espalier(const Mesh& mesh, unsigned bits, unsigned effort) {
    return std::make_unique<EspalierSystem>(mesh, bits, effort);
}

std::vector<std::unique_ptr<System>> make_systems(const Mesh& mesh, unsigned bits, unsigned effort,
                                                  [[maybe_unused]] bool reference_only) {
    std::vector<std::unique_ptr<System>> systems;
#if defined(ESPALIER_BENCH_EMBREE)
    systems.push_back(make_embree(mesh, EmbreeMode::fast));
    if (!reference_only) {
        systems.push_back(make_embree(mesh, EmbreeMode::compact));
        systems.push_back(make_embree(mesh, EmbreeMode::robust));
        systems.push_back(make_embree(mesh, EmbreeMode::compact_robust));
    }
#endif
    systems.push_back(make_espalier(mesh, bits, effort));
    return systems;
}

}  // namespace espalier::bench
