#include <cmath>

#include "../broad_phase.hpp"

namespace espalier::bench {
namespace {

/// The loop in float that a program has which hands boxes to its broad phase: the box of a turned cube.
class PlacementLoop final : public BroadPhase {
public:
    explicit PlacementLoop(const Start& start) : boxes_(start.boxes.begin(), start.boxes.end()) {}

    void step(const Frame& frame, Parts& parts, PairList&) override {
        parts.begin();
        for (const Movement& movement : frame.movements) boxes_[movement.instance.slot] = box_at(movement.transform);
        parts.end(Part::update);
    }

private:
    static Box box_at(const Transform& t) {
        const Quaternion& q = t.rotation;
        const float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
        const float xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
        const float wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
        const float half = 0.5f * t.scale;
        const auto reach = [half](float a, float b, float c) {
            return half * (std::abs(a) + std::abs(b) + std::abs(c));
        };
        const float x = reach(1.0f - 2.0f * (yy + zz), 2.0f * (xy - wz), 2.0f * (xz + wy));
        const float y = reach(2.0f * (xy + wz), 1.0f - 2.0f * (xx + zz), 2.0f * (yz - wx));
        const float z = reach(2.0f * (xz - wy), 2.0f * (yz + wx), 1.0f - 2.0f * (xx + yy));
        const Vec3& at = t.translation;
        return {{at.x - x, at.y - y, at.z - z}, {at.x + x, at.y + y, at.z + z}};
    }

    std::vector<Box> boxes_;
};

}  // namespace

BroadPhaseMakers placement_loop_makers() {
    BroadPhaseMakers makers = {maker_of<PlacementLoop>("loop that makes boxes", "placements")};
    makers[0].finds = Finds::none;
    makers[0].has_history = false;
    return makers;
}

}  // namespace espalier::bench
