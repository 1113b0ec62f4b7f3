#include "structures.hpp"

#include "../exactness/kernels.hpp"
#include "../study/walks.hpp"

namespace espalier::bench {

namespace {

constexpr double grid_density = 5.0;  // of Wald et al. 2006

/// Counts nodes whose boxes were tested.
class Hierarchy final : public Structure {
public:
    explicit Hierarchy(const TreeAndBlob& built, const FloatTest* float_test = nullptr)
        : tree_(&built.tree), rays_(built.tree), float_test_(float_test) {
        name = "hierarchy";
        build_seconds = built.tree_seconds;
        cells = built.tree.nodes.size();
        references = built.tree.triangles.size();
        bytes = cells * sizeof(AabbNode);
    }
    double closest(const Ray& ray, RayWork& work) override {
        if (float_test_ != nullptr) return static_cast<double>(closest_hit(rays_, *float_test_, ray));
        return rays_.closest(RayOrder::nearest_first, ray, work);
    }
    std::size_t count_touching(const Aabb& box, RayWork& work) override {
        float center[3], half[3];
        for (std::size_t k = 0; k < 3; ++k) {
            center[k] = 0.5f * (box.low[k] + box.high[k]);
            half[k] = 0.5f * (box.high[k] - box.low[k]);
        }
        const auto is_near = [&](const StoredAabb& node) {
            for (int k = 0; k < 3; ++k)
                if (std::abs(node.center[k] - center[k]) > node.half[k] + half[k]) return false;
            return true;
        };
        const TriangleBoxTest test(box);
        const auto touches = [&](const Corners3& triangle) { return test.touches(triangle); };
        const NodesOfTree<StoredAabb> nodes = {tree_, tree_->nodes};
        const std::size_t touching = bench::count_touching(nodes, stack_, work, is_near, touches);
        --work.box_tests;  // of the root, which all boxes reach
        return touching;
    }

private:
    const AabbTree* tree_;
    RayWalk rays_;
    std::vector<std::uint32_t> stack_;
    const FloatTest* float_test_;
};

class BlobStructure final : public Structure {
public:
    explicit BlobStructure(const SubdivisionSubject& subject) : blob_(subject.built.baked.blob) {
        name = "espalier";
        references = subject.snapped.mesh.triangles.size();
        bytes = blob_.size();
        has_triangles = true;
        has_work = false;
        is_reference = false;
    }
    double closest(const Ray& ray, RayWork&) override { return static_cast<double>(raycast(blob_, ray).t); }
    std::size_t count_touching(const Aabb& box, RayWork&) override {
        std::size_t touching = 0;
        const QueryStatus status =
            for_each_overlap(blob_, Box{{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}},
                             [&](TriangleId) { ++touching; });
        if (is_refused(status)) throw std::runtime_error(std::string("a box is refused: ") + describe(status));
        return touching;
    }

private:
    Blob blob_;
};

std::vector<std::unique_ptr<Structure>> subdivisions(const SubdivisionSubject& subject, const FloatTest* float_test) {
    const std::span<const FloatTriangle> triangles = subject.built.tree.triangles;
    const float margin = subject.built.tree.largest * cell_margin_share;
    std::vector<std::unique_ptr<Structure>> made;
    made.push_back(std::make_unique<KdTree>(triangles, margin, float_test));
    made.push_back(std::make_unique<UniformGrid>(triangles, grid_density, margin, float_test));
    return made;
}

}  // namespace

SubdivisionSubject make_subdivision_subject(Mesh mesh) {
    SubdivisionSubject subject;
    bring_to_common_size(mesh);
    subject.snapped = snap_mesh(mesh);
    subject.built = build_tree_and_blob(subject.snapped.mesh, 4);
    return subject;
}

std::vector<std::unique_ptr<Structure>> all_structures(const SubdivisionSubject& subject) {
    std::vector<std::unique_ptr<Structure>> made;
    made.push_back(std::make_unique<Hierarchy>(subject.built));
    for (auto& structure : subdivisions(subject, nullptr)) made.push_back(std::move(structure));
    made.push_back(std::make_unique<BlobStructure>(subject));
    return made;
}

std::vector<std::unique_ptr<Structure>> structures_with_float_test(const SubdivisionSubject& subject,
                                                                   const FloatTest& float_test) {
    std::vector<std::unique_ptr<Structure>> made = subdivisions(subject, &float_test);
    made.push_back(std::make_unique<Hierarchy>(subject.built, &float_test));
    return made;
}

}  // namespace espalier::bench
