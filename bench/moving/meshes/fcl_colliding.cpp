#include <fcl/fcl.h>

#include "colliding.hpp"

namespace espalier::bench {
namespace {

template <class Scalar>
using Model = fcl::BVHModel<fcl::OBBRSS<Scalar>>;

template <class Scalar>
std::shared_ptr<Model<Scalar>> model_of(const tests::Mesh& mesh) {
    std::vector<fcl::Vector3<Scalar>> positions;
    for (const Vec3& p : mesh.positions)
        positions.emplace_back(static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z));
    std::vector<fcl::Triangle> triangles;
    for (const TriangleVertices& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    auto model = std::make_shared<Model<Scalar>>();
    model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(positions.size()));
    model->addSubModel(positions, triangles);
    model->endModel();
    return model;
}

/// Objects of FCL over one mesh, its tree of objects, and its collision of two meshes.
template <class Scalar>
class FclBunnies final : public BroadPhase {
public:
    FclBunnies(const Start& start, const std::shared_ptr<Model<Scalar>>& model) {
        for (std::size_t slot = 0; slot < start.instances.size(); ++slot) {
            owned_.push_back(std::make_unique<Object>(model));
            owned_.back()->setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(slot)));
            objects_.push_back(owned_.back().get());
            set(*objects_.back(), start.instances[slot].transform);
        }
        manager_.registerObjects(objects_);
        manager_.setup();
    }
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        for (const Movement& movement : frame.movements) set(*objects_[movement.instance.slot], movement.transform);
        manager_.update();
        parts.end(Part::update);
        manager_.collide(&pairs, [](Object* a, Object* b, void* data) {
            const fcl::CollisionRequest<Scalar> request(1, false);
            fcl::CollisionResult<Scalar> result;
            fcl::collide(a, b, request, result);
            if (result.isCollision()) static_cast<PairList*>(data)->add(slot_of(*a), slot_of(*b));
            return false;
        });
        parts.end(Part::pairs);
    }

private:
    using Object = fcl::CollisionObject<Scalar>;
    static std::uint32_t slot_of(const Object& object) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
    }
    static void set(Object& object, const Transform& place) {
        const Quaternion& q = place.rotation;
        object.setTransform(
            fcl::Quaternion<Scalar>(static_cast<Scalar>(q.w), static_cast<Scalar>(q.x), static_cast<Scalar>(q.y),
                                    static_cast<Scalar>(q.z)),
            fcl::Vector3<Scalar>(static_cast<Scalar>(place.translation.x), static_cast<Scalar>(place.translation.y),
                                 static_cast<Scalar>(place.translation.z)));
        object.computeAABB();
    }

    fcl::DynamicAABBTreeCollisionManager<Scalar> manager_;
    std::vector<std::unique_ptr<Object>> owned_;
    std::vector<Object*> objects_;
};

template <class Scalar>
BroadPhaseMaker maker_with(const char* name, const tests::Mesh& mesh) {
    return maker_of<FclBunnies<Scalar>>(name, "placements", model_of<Scalar>(mesh));
}

}  // namespace

BroadPhaseMakers fcl_colliding_makers(const tests::Mesh& mesh) {
    return {maker_with<double>("fcl, doubles", mesh), maker_with<float>("fcl, floats", mesh)};
}

}  // namespace espalier::bench
