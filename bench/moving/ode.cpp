#include "../peers/ode.hpp"
#include "broad_phase.hpp"

namespace espalier::bench::moving {
namespace {

/// A geometry that is only a box, which the program hands over.
struct Handed {
    dReal box[6];
    std::uint32_t slot;
};

void read_box(dGeomID geometry, dReal box[6]) {
    const auto* const handed = static_cast<const Handed*>(dGeomGetClassData(geometry));
    for (int i = 0; i < 6; ++i) box[i] = handed->box[i];
}
dColliderFn* no_collider(int) { return nullptr; }

/// Returns the class of such geometries.
int handed_class() {
    static const int number = [] {
        start_ode();
        dGeomClass described{};
        described.bytes = sizeof(Handed);
        described.collider = no_collider;
        described.aabb = read_box;
        return dCreateGeomClass(&described);
    }();
    return number;
}

enum class Space { sweep_and_prune, quadtree, hash };

class OdeBoxes final : public BroadPhase {
public:
    OdeBoxes(const Start& start, Space space) {
        const int number = handed_class();
        space_ = made(start, space);
        for (std::uint32_t slot = 0; slot < start.boxes.size(); ++slot) {
            const dGeomID geometry = dCreateGeom(number);
            static_cast<Handed*>(dGeomGetClassData(geometry))->slot = slot;
            geometries_.push_back(geometry);
            set(geometry, start.boxes[slot]);
            dSpaceAdd(space_, geometry);
        }
    }
    /// The space destroys its geometries.
    ~OdeBoxes() override { dSpaceDestroy(space_); }
    OdeBoxes(const OdeBoxes&) = delete;
    OdeBoxes& operator=(const OdeBoxes&) = delete;

    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        for (const Movement& movement : frame.movements) {
            const std::uint32_t slot = movement.instance.slot;
            set(geometries_[slot], frame.boxes[slot]);
        }
        parts.end(Part::update);
        dSpaceCollide(space_, &pairs, [](void* data, dGeomID a, dGeomID b) {
            static_cast<PairList*>(data)->add(slot_of(a), slot_of(b));
        });
        parts.end(Part::pairs);
    }

private:
    static std::uint32_t slot_of(dGeomID geometry) {
        return static_cast<const Handed*>(dGeomGetClassData(geometry))->slot;
    }
    static void set(dGeomID geometry, const Box& box) {
        auto& handed = *static_cast<Handed*>(dGeomGetClassData(geometry));
        const float sides[6] = {box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z};
        for (int i = 0; i < 6; ++i) handed.box[i] = static_cast<dReal>(sides[i]);
        // Its position counts for nothing, but a call that moves it makes the space read its box.
        dGeomSetPosition(geometry, handed.box[0], handed.box[2], handed.box[4]);
    }
    static dSpaceID made(const Start& start, Space space) {
        const auto half = static_cast<dReal>(0.5f * start.motion.side());
        if (space == Space::sweep_and_prune) return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
        if (space == Space::quadtree) {
            const dVector3 center = {half, half, half}, extents = {half, half, half};
            // A block of the lowest level has four objects or less.
            int depth = 1;
            while (std::size_t{4} << 2 * depth < start.boxes.size()) ++depth;
            return dQuadTreeSpaceCreate(nullptr, center, extents, depth);
        }
        const dSpaceID hash = dHashSpaceCreate(nullptr);
        // Cells from the smallest cube to the largest one.
        dHashSpaceSetLevels(hash, 0, start.scenario.sizes == Sizes::cubes ? 1 : 7);
        return hash;
    }

    dSpaceID space_ = nullptr;
    std::vector<dGeomID> geometries_;
};

}  // namespace

BroadPhaseMakers ode_box_makers() {
    BroadPhaseMakers makers = {maker_of<OdeBoxes>("ode, sweep and prune", "boxes", Space::sweep_and_prune),
                               maker_of<OdeBoxes>("ode, quadtree", "boxes", Space::quadtree),
                               maker_of<OdeBoxes>("ode, hash", "boxes", Space::hash)};
    for (BroadPhaseMaker& maker : makers) maker.has_history = false;
    return makers;
}

}  // namespace espalier::bench::moving
