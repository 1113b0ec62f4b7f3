#include "../peers/embree.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

/// A geometry of quality REFIT that reads its vertices in place. Only scenes that are dynamic and of quality LOW have a
/// tree for each geometry, which they can refit. Leaves of compact scenes hold indices, so that a refit writes nodes
/// alone; those of others hold vertices.
class EmbreeRefit final : public RefitSystem {
public:
    EmbreeRefit(const Mesh& mesh, int flags) : RefitSystem(mesh) {
        mesh_.positions.emplace_back();  // Embree reads 16 bytes at the last vertex
        scene_ = rtcNewScene(device_.get());
        rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | flags));
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
        geometry_ = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
        rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh_.positions.data(), 0,
                                   sizeof(Vec3), mesh.positions.size());
        rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh_.triangles.data(), 0,
                                   sizeof(TriangleVertices), mesh_.triangles.size());
        rtcCommitGeometry(geometry_);
        rtcAttachGeometry(scene_, geometry_);
        rtcCommitScene(scene_);
    }
    ~EmbreeRefit() override {
        rtcReleaseGeometry(geometry_);
        rtcReleaseScene(scene_);
    }
    void refit() override {
        rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(geometry_);
        rtcCommitScene(scene_);
    }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        RTCBounds bounds;
        rtcGetSceneBounds(scene_, &bounds);
        return is_within(
            point, {{bounds.lower_x, bounds.lower_y, bounds.lower_z}, {bounds.upper_x, bounds.upper_y, bounds.upper_z}},
            rounding);
    }
    [[nodiscard]] std::size_t bytes() const override {
        return device_.bytes() + mesh_.positions.size() * sizeof(Vec3) +
               mesh_.triangles.size() * sizeof(TriangleVertices);
    }

private:
    EmbreeDevice device_;
    RTCScene scene_;
    RTCGeometry geometry_;
};

}  // namespace

RefitMakers embree_refit_makers() {
    RefitMakers makers;
    const auto add = [&](const char* profile, int flags) {
        makers.push_back({"embree", profile, RTC_VERSION_STRING, [flags](const Mesh& mesh, const Box&) {
                              return std::make_unique<EmbreeRefit>(mesh, flags);
                          }});
    };
    add("refit", RTC_SCENE_FLAG_NONE);
    add("refit robust", RTC_SCENE_FLAG_ROBUST);
    add("refit compact", RTC_SCENE_FLAG_COMPACT);
    return makers;
}

}  // namespace espalier::bench
