#include <fcl/fcl.h>

#include "../peers/fcl.hpp"
#include "pairs.hpp"

namespace espalier::bench {
namespace {

template <class Scalar>
class FclPairs {
public:
    explicit FclPairs(const Mesh& mesh) : model_(std::make_shared<Model>()) {
        FclArrays<fcl::OBBRSS<Scalar>>(mesh).build(*model_);
        here_ = fcl::Transform3<Scalar>::Identity();
    }
    bool yes_no(const Transform& pose) {
        fcl::CollisionRequest<Scalar> request(1, false);
        fcl::CollisionResult<Scalar> result;
        fcl::collide(model_.get(), here_, model_.get(), transform(pose), request, result);
        return result.isCollision();
    }
    std::size_t all(const Transform& pose) {
        fcl::CollisionRequest<Scalar> request(10'000'000, false);
        fcl::CollisionResult<Scalar> result;
        fcl::collide(model_.get(), here_, model_.get(), transform(pose), request, result);
        return result.numContacts();
    }
    double distance(const Transform& pose) {
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

template <class Scalar>
void add(const char* profile, const Mesh& mesh, PairContests& to) {
    const auto pairs = std::make_shared<FclPairs<Scalar>>(mesh);
    to.yes_no.push_back({"fcl", profile, one_by_one([pairs](const Transform& pose) { return pairs->yes_no(pose); })});
    to.all.push_back({"fcl", profile, one_by_one([pairs](const Transform& pose) { return pairs->all(pose); })});
    to.distance.push_back(
        {"fcl", profile, one_by_one([pairs](const Transform& pose) { return pairs->distance(pose); })});
}

}  // namespace

void add_fcl_pairs(const Mesh& mesh, PairContests& to) {
    add<double>("obbrss double", mesh, to);
    add<float>("obbrss float", mesh, to);
}

}  // namespace espalier::bench
