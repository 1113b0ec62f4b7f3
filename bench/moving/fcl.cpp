#include <fcl/fcl.h>

#include "../peers/fcl.hpp"
#include "broad_phase.hpp"

namespace espalier::bench::moving {
namespace {

/// Objects of FCL that know their slots.
template <class Scalar>
class FclObjects {
public:
    using Object = fcl::CollisionObject<Scalar>;

    Object& add(const std::shared_ptr<fcl::CollisionGeometry<Scalar>>& geometry) {
        owned_.push_back(std::make_unique<Object>(geometry));
        owned_.back()->setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(objects.size())));
        objects.push_back(owned_.back().get());
        return *objects.back();
    }
    static std::uint32_t slot_of(const Object& object) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
    }
    static void add_pair(void* pairs, const Object& a, const Object& b) {
        static_cast<PairList*>(pairs)->add(slot_of(a), slot_of(b));
    }
    std::vector<Object*> objects;

private:
    std::vector<std::unique_ptr<Object>> owned_;
};

/// A manager of FCL whose objects have boxes that the program hands over.
template <class Manager, class Scalar>
class FclBoxes final : public BroadPhase {
public:
    explicit FclBoxes(const Start& start) {
        for (std::uint32_t slot = 0; slot < start.boxes.size(); ++slot) {
            // The geometry is that of a unit cube, but FCL reads only the box.
            geometries_.push_back(std::make_shared<fcl::Box<Scalar>>(Scalar{1}, Scalar{1}, Scalar{1}));
            all_.add(geometries_.back());
            set(slot, start.boxes[slot]);
        }
        manager_.registerObjects(all_.objects);
        manager_.setup();
    }
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        moved_.clear();
        for (const Movement& movement : frame.movements) {
            const std::uint32_t slot = movement.instance.slot;
            set(slot, frame.boxes[slot]);
            moved_.push_back(all_.objects[slot]);
        }
        // The first refits the whole tree, the second inserts objects again.
        if (moved_.size() == all_.objects.size()) manager_.update();
        else manager_.update(moved_);
        parts.end(Part::update);
        manager_.collide(&pairs, [](Object* a, Object* b, void* data) {
            // It also calls with some pairs that do not touch.
            if (a->getAABB().overlap(b->getAABB())) Objects::add_pair(data, *a, *b);
            return false;
        });
        parts.end(Part::pairs);
    }

private:
    using Objects = FclObjects<Scalar>;
    using Object = typename Objects::Object;
    void set(std::uint32_t slot, const Box& box) {
        geometries_[slot]->aabb_local = fcl::AABB<Scalar>(fcl_vector<Scalar>(box.min), fcl_vector<Scalar>(box.max));
        all_.objects[slot]->computeAABB();
    }

    Manager manager_;
    std::vector<std::shared_ptr<fcl::Box<Scalar>>> geometries_;
    Objects all_;
    std::vector<Object*> moved_;
};

}  // namespace

BroadPhaseMakers fcl_box_makers() {
    return {maker_of<FclBoxes<fcl::DynamicAABBTreeCollisionManager<double>, double>>("fcl, tree", "boxes"),
            maker_of<FclBoxes<fcl::DynamicAABBTreeCollisionManager<float>, float>>("fcl, tree of floats", "boxes"),
            maker_of<FclBoxes<fcl::DynamicAABBTreeCollisionManager_Array<double>, double>>("fcl, array", "boxes")};
}

namespace {

template <class Scalar>
using Model = fcl::BVHModel<fcl::OBBRSS<Scalar>>;

/// Objects of FCL over one mesh, its tree of objects, and its collision of two meshes.
template <class Scalar>
class FclBunnies final : public BroadPhase {
public:
    FclBunnies(const Start& start, const std::shared_ptr<Model<Scalar>>& model) {
        for (std::size_t slot = 0; slot < start.instances.size(); ++slot) {
            set(all_.add(model), start.instances[slot].transform);
        }
        manager_.registerObjects(all_.objects);
        manager_.setup();
    }
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        for (const Movement& movement : frame.movements) set(*all_.objects[movement.instance.slot], movement.transform);
        manager_.update();
        parts.end(Part::update);
        manager_.collide(&pairs, [](Object* a, Object* b, void* data) {
            const fcl::CollisionRequest<Scalar> request(1, false);
            fcl::CollisionResult<Scalar> result;
            fcl::collide(a, b, request, result);
            if (result.isCollision()) Objects::add_pair(data, *a, *b);
            return false;
        });
        parts.end(Part::pairs);
    }

private:
    using Objects = FclObjects<Scalar>;
    using Object = typename Objects::Object;
    static void set(Object& object, const Transform& place) {
        const Quaternion& q = place.rotation;
        object.setTransform(fcl::Quaternion<Scalar>(static_cast<Scalar>(q.w), static_cast<Scalar>(q.x),
                                                    static_cast<Scalar>(q.y), static_cast<Scalar>(q.z)),
                            fcl_vector<Scalar>(place.translation));
        object.computeAABB();
    }

    fcl::DynamicAABBTreeCollisionManager<Scalar> manager_;
    Objects all_;
};

template <class Scalar>
BroadPhaseMaker maker_with(const char* name, const tests::Mesh& mesh) {
    auto model = std::make_shared<Model<Scalar>>();
    FclArrays<fcl::OBBRSS<Scalar>>(mesh).build(*model);
    return maker_of<FclBunnies<Scalar>>(name, "placements", model);
}

}  // namespace

BroadPhaseMakers fcl_colliding_makers(const tests::Mesh& mesh) {
    return {maker_with<double>("fcl, doubles", mesh), maker_with<float>("fcl, floats", mesh)};
}

}  // namespace espalier::bench::moving
