#include "../peers/fcl.hpp"
#include "subject.hpp"

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
    explicit FclRefit(const Mesh& mesh) : RefitSystem(mesh), positions_(fcl_positions<Scalar>(mesh.positions)) {
        FclArrays<Volume>(mesh).build(model_);
    }
    void set_positions(const std::vector<Vec3>& positions) override { positions_ = fcl_positions<Scalar>(positions); }
    void refit() override {
        model_.beginReplaceModel();
        model_.replaceSubModel(positions_);
        model_.endReplaceModel(true, boxes == Boxes::merged);
    }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        const Volume& root = model_.getBV(0).bv;
        const fcl::Vector3<Scalar> from_center = fcl_vector<Scalar>(point) - root.center();
        // No box reaches farther than a sphere around it.
        const Scalar x = root.width(), y = root.height(), z = root.depth();
        return from_center.norm() <= std::sqrt(x * x + y * y + z * z) / 2 + static_cast<Scalar>(rounding);
    }
    [[nodiscard]] std::size_t bytes() const override { return bytes_of(model_); }

private:
    using Scalar = typename Volume::S;

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
