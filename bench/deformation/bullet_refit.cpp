#include "../peers/bullet.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

btVector3 vector(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A quantised btOptimizedBvh over the range of motion, so that no box of a pose has to be found first.
/// btBvhTriangleMeshShape::refitTree() also finds that box, by six passes over all triangles.
class BulletRefit final : public RefitSystem {
public:
    BulletRefit(const Mesh& mesh, const Box& range, bool whole_shape)
        : RefitSystem(mesh),
          arrays_(bullet_arrays(mesh_)),
          low_(vector(range.min)),
          high_(vector(range.max)),
          shape_(&arrays_, true, low_, high_),
          whole_shape_(whole_shape) {}
    void refit() override {
        if (whole_shape_) shape_.refitTree(low_, high_);
        else shape_.getOptimizedBvh()->refit(&arrays_, low_, high_);
    }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        btOptimizedBvh& tree = *const_cast<btBvhTriangleMeshShape&>(shape_).getOptimizedBvh();
        const btQuantizedBvhNode& root = tree.getQuantizedNodeArray()[0];
        const btVector3 low = tree.unQuantize(root.m_quantizedAabbMin), high = tree.unQuantize(root.m_quantizedAabbMax);
        return is_within(point, {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}}, rounding);
    }
    [[nodiscard]] std::size_t bytes() const override { return bullet_bytes(shape_, mesh_); }

private:
    btTriangleIndexVertexArray arrays_;
    btVector3 low_, high_;
    btBvhTriangleMeshShape shape_;
    bool whole_shape_;
};

}  // namespace

RefitMakers bullet_refit_makers() {
    RefitMakers makers;
    const auto add = [&](const char* profile, bool whole_shape) {
        makers.push_back({"bullet", profile, bullet_version(), [whole_shape](const Mesh& mesh, const Box& range) {
                              return std::make_unique<BulletRefit>(mesh, range, whole_shape);
                          }});
    };
    add("tree", false);
    add("shape", true);
    return makers;
}

}  // namespace espalier::bench
