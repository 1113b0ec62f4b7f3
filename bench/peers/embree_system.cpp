#include "embree.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

// Building is the commit; the copies of the arrays into Embree's buffers are made before.
class EmbreeSystem final : public System {
public:
    EmbreeSystem(const Mesh& mesh, int flags) : scene_(device_.new_scene(mesh)) {
        rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(flags));
        const Stopwatch watch;
        rtcCommitScene(scene_);
        seconds_ = watch.seconds();
    }
    ~EmbreeSystem() override { rtcReleaseScene(scene_); }
    [[nodiscard]] std::size_t bytes() const override { return device_.bytes(); }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool coherent, std::vector<Hit>& hits) override {
        EmbreeRays asked(scene_, coherent);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RTCRayHit query = asked.closest(rays[i]);
            hits[i].found = is_hit(query);
            if (hits[i].found)
                hits[i] = {true,
                           query.ray.tfar,
                           query.hit.u,
                           query.hit.v,
                           Vec3{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z},
                           query.hit.primID};
        }
    }
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        EmbreeRays asked(scene_);
        for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = asked.hits_any(rays[i]);
    }

private:
    EmbreeDevice device_;
    RTCScene scene_;
    double seconds_ = 0.0;
};

}  // namespace

#if RTC_VERSION_MAJOR >= 4
// All that the library of this version shows (checkouts.cmake).
__attribute__((visibility("default"))) std::vector<Maker> embree4_makers() {
    constexpr const char* name = "embree4";
#else
std::vector<Maker> embree_makers() {
    constexpr const char* name = "embree";
#endif
    struct Mode {
        const char* profile;
        int flags;
    };
    const Mode modes[] = {
        {"default", RTC_SCENE_FLAG_NONE},
        {"compact", RTC_SCENE_FLAG_COMPACT},
        {"robust", RTC_SCENE_FLAG_ROBUST},
        {"compact+robust", RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_ROBUST},
    };
    std::vector<Maker> makers;
    for (const Mode& mode : modes)
        makers.push_back({name, mode.profile, RTC_VERSION_STRING, [flags = mode.flags](const Mesh& mesh) {
                              return std::make_unique<EmbreeSystem>(mesh, flags);
                          }});
    return makers;
}

}  // namespace espalier::bench
