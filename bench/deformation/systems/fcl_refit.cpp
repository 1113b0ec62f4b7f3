#include <fcl/config.h>
#include <fcl/math/bv/utility.h>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>

#include <type_traits>

#include "../refit_system.hpp"

namespace espalier::bench {
namespace {

enum class Boxes {
    merged,  ///< from the bottom up, each from its children's
    anew,    ///< from the top down, each around all its triangles
};

/// Replacing the model copies the vertices one by one, which is a part of the refit. Updating it would make boxes
/// around two poses, the one before too.
template <class Volume, Boxes boxes>
class FclRefit final : public RefitSystem {
public:
    explicit FclRefit(const Mesh& mesh) {
        set_positions(mesh.positions);
        std::vector<fcl::Triangle> triangles;
        for (const TriangleVertices& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
        model_.beginModel(static_cast<int>(triangles.size()), static_cast<int>(positions_.size()));
        model_.addSubModel(positions_, triangles);
        model_.endModel();
    }
    void set_positions(const std::vector<Vec3>& positions) override {
        positions_.clear();
        for (const Vec3& p : positions) positions_.push_back(vector(p));
    }
    void refit() override {
        model_.beginReplaceModel();
        model_.replaceSubModel(positions_);
        model_.endReplaceModel(true, boxes == Boxes::merged);
    }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        const Volume& root = model_.getBV(0).bv;
        const fcl::Vector3<Scalar> from_center = vector(point) - root.center();
        // No box reaches farther than a sphere around it.
        const Scalar x = root.width(), y = root.height(), z = root.depth();
        return from_center.norm() <= std::sqrt(x * x + y * y + z * z) / 2 + static_cast<Scalar>(rounding);
    }
    [[nodiscard]] std::size_t bytes() const override {
        return static_cast<std::size_t>(model_.getNumBVs()) * sizeof(fcl::BVNode<Volume>) +
               static_cast<std::size_t>(model_.num_vertices) * sizeof(fcl::Vector3<Scalar>) +
               static_cast<std::size_t>(model_.num_tris) * sizeof(fcl::Triangle);
    }

private:
    using Scalar = typename Volume::S;
    static fcl::Vector3<Scalar> vector(const Vec3& p) {
        return {static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z)};
    }
    std::vector<fcl::Vector3<Scalar>> positions_;
    fcl::BVHModel<Volume> model_;
};

template <class Volume, Boxes boxes = Boxes::merged>
RefitMaker maker(const char* profile) {
    return {"fcl", profile, FCL_VERSION,
            [](const Mesh& mesh, const Box&) { return std::make_unique<FclRefit<Volume, boxes>>(mesh); },
            // The direction of a flat triangle becomes NaN.
            !std::is_same_v<Volume, fcl::AABB<typename Volume::S>>};
}

}  // namespace

RefitMakers fcl_refit_makers() {
    return {maker<fcl::AABB<float>>("aabb float"),
            maker<fcl::AABB<double>>("aabb double"),
            maker<fcl::OBB<float>>("obb merged float"),
            maker<fcl::OBB<double>>("obb merged double"),
            maker<fcl::OBB<float>, Boxes::anew>("obb anew float"),
            maker<fcl::OBB<double>, Boxes::anew>("obb anew double"),
            maker<fcl::OBBRSS<float>>("obbrss merged float"),
            maker<fcl::OBBRSS<double>>("obbrss merged double")};
}

}  // namespace espalier::bench
