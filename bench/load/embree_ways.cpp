// Ways through Embree's builders, on one thread.

#include "../peers/embree.hpp"
#include "ways.hpp"

namespace espalier::bench {
namespace {

struct Build {
    const char* name;
    RTCBuildQuality quality;
    int flags;
};
constexpr std::array builds = {Build{"Embree, low", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_NONE},
                               Build{"Embree, medium", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE},
                               Build{"Embree, high", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE},
                               Build{"Embree, compact", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_COMPACT}};
constexpr const Build& default_build = builds[1];

/// Started with the first load, as a program has one for all of its meshes.
const EmbreeDevice& device() {
    static const EmbreeDevice started;
    return started;
}

class EmbreeLoaded final : public Loaded {
public:
    EmbreeLoaded(std::span<const std::byte> file, ReadMesh read, const Build& build) : bytes_before_(device().bytes()) {
        const MeshCounts counts = read_counts(file);
        scene_ =
            device().new_scene(counts.vertices, counts.triangles, build.quality, [&](void* vertices, void* corners) {
                read(file, {static_cast<float*>(vertices), static_cast<std::uint32_t*>(corners)});
            });
        rtcSetSceneBuildQuality(scene_, build.quality);
        rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(build.flags));
        rtcCommitScene(scene_);
        bytes_ = device().bytes() - bytes_before_;
    }
    ~EmbreeLoaded() override { rtcReleaseScene(scene_); }
    EmbreeLoaded(const EmbreeLoaded&) = delete;
    EmbreeLoaded& operator=(const EmbreeLoaded&) = delete;

    [[nodiscard]] float closest(const Ray& ray) const override {
        const RTCRayHit query = EmbreeRays(scene_).closest(ray);
        return is_hit(query) ? query.ray.tfar : std::numeric_limits<float>::infinity();
    }
    [[nodiscard]] std::size_t bytes() const override { return bytes_; }

private:
    std::size_t bytes_before_;
    RTCScene scene_;
    std::size_t bytes_ = 0;
};

auto loader(ReadMesh read, const Build& build) {
    return [read, build](std::span<const std::byte> file) -> std::unique_ptr<Loaded> {
        return std::make_unique<EmbreeLoaded>(file, read, build);
    };
}

}  // namespace

void add_embree_ways(std::vector<Way>& ways, const Mesh& mesh) {
    ways.push_back({"floats", default_build.name, write_floats(mesh), loader(read_floats, default_build)});
}

#ifdef ESPALIER_BENCH_MESHOPT
void add_embree_meshopt_ways(std::vector<Way>& ways, const Bytes& file) {
    for (const Build& build : builds) ways.push_back({"meshoptimizer", build.name, file, loader(read_meshopt, build)});
}
#endif

}  // namespace espalier::bench
