#include <fcl/fcl.h>

#include "../fcl.hpp"
#include "pair_system.hpp"

namespace espalier::bench {
namespace {

template <class Scalar>
class FclPairs final : public PairSystem {
public:
    explicit FclPairs(const Mesh& mesh) : model_(std::make_shared<Model>()) {
        FclArrays<fcl::OBBRSS<Scalar>>(mesh).build(*model_);
        here_ = fcl::Transform3<Scalar>::Identity();
    }
    bool yes_no(const Transform& pose) override {
        fcl::CollisionRequest<Scalar> request(1, false);
        fcl::CollisionResult<Scalar> result;
        fcl::collide(model_.get(), here_, model_.get(), transform(pose), request, result);
        return result.isCollision();
    }
    std::size_t all(const Transform& pose) override {
        fcl::CollisionRequest<Scalar> request(10'000'000, false);
        fcl::CollisionResult<Scalar> result;
        fcl::collide(model_.get(), here_, model_.get(), transform(pose), request, result);
        return result.numContacts();
    }
    double distance(const Transform& pose) override {
        fcl::DistanceRequest<Scalar> request;
        fcl::DistanceResult<Scalar> result;
        fcl::distance(model_.get(), here_, model_.get(), transform(pose), request, result);
        return static_cast<double>(result.min_distance);
    }

private:
    using Model = fcl::BVHModel<fcl::OBBRSS<Scalar>>;
    static fcl::Transform3<Scalar> transform(const Transform& pose) {
        fcl::Transform3<Scalar> result = fcl::Transform3<Scalar>::Identity();
        const Matrix matrix = rotation_matrix(pose);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) result.linear()(i, j) = static_cast<Scalar>(matrix.at[i][j]);
        result.translation() = fcl_vector<Scalar>(pose.translation);
        return result;
    }
    std::shared_ptr<Model> model_;
    fcl::Transform3<Scalar> here_;
};

}  // namespace

std::vector<PairMaker> fcl_pair_makers() {
    return {{"fcl", "obbrss double", [](const Mesh& mesh) { return std::make_unique<FclPairs<double>>(mesh); }},
            {"fcl", "obbrss float", [](const Mesh& mesh) { return std::make_unique<FclPairs<float>>(mesh); }}};
}

}  // namespace espalier::bench
