#include <fcl/fcl.h>

#include "pair_system.hpp"

namespace espalier::bench {
namespace {

template <class Scalar>
class FclPairs final : public PairSystem {
public:
    explicit FclPairs(const Mesh& mesh) : model_(std::make_shared<Model>()) {
        std::vector<fcl::Vector3<Scalar>> positions;
        for (const Vec3& p : mesh.positions)
            positions.emplace_back(static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z));
        std::vector<fcl::Triangle> triangles;
        for (const TriangleVertices& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
        model_->beginModel(static_cast<int>(triangles.size()), static_cast<int>(positions.size()));
        model_->addSubModel(positions, triangles);
        model_->endModel();
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
        result.translation() =
            fcl::Vector3<Scalar>(static_cast<Scalar>(pose.translation.x), static_cast<Scalar>(pose.translation.y),
                                 static_cast<Scalar>(pose.translation.z));
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
