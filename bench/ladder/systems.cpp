#include "systems.hpp"

#include <stdexcept>
#include <utility>

#include "walk.hpp"

namespace espalier::bench {
namespace {

template <class Tree>
class TextbookSystem final : public TreeSystem {
public:
    TextbookSystem(const std::string& name, const LadderSubject& subject, const TreeShape& shape, StoredBoxes stored)
        : TreeSystem(name),
          subject_(&subject),
          shape_(&shape),
          stored_(stored),
          tree_(subject.boxed(shape)),
          walk_(tree_, subject.mesh, shape.height) {}

    [[nodiscard]] unsigned degree() const override { return Tree::degree; }
    [[nodiscard]] TreeBytes bytes() const override {
        const Mesh& mesh = subject_->mesh;
        const std::size_t node_bytes = sizeof(tree_.nodes[0]);
        return {tree_.nodes.size(), node_bytes,
                tree_.nodes.size() * node_bytes + mesh.triangles.size() * sizeof(TriangleVertices) +
                    mesh.positions.size() * sizeof(Vec3)};
    }
    void find_closest(std::span<const Ray> rays, std::span<float> hits) override {
        NoWork work;
        for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = walk_.closest(rays[i], work);
    }
    void count_touching(std::span<const Aabb> boxes, std::span<std::uint64_t> counts) override {
        NoWork work;
        for (std::size_t i = 0; i < boxes.size(); ++i) counts[i] = walk_.count_touching(boxes[i], work);
    }
    [[nodiscard]] TreeWork count_rays(std::span<const Ray> rays) override {
        TreeWork work;
        for (const Ray& ray : rays) static_cast<void>(walk_.closest(ray, work));
        return work;
    }
    [[nodiscard]] TreeWork count_boxes(std::span<const Aabb> boxes) override {
        TreeWork work;
        for (const Aabb& box : boxes) static_cast<void>(walk_.count_touching(box, work));
        return work;
    }
    void recount(std::span<const Ray> rays, std::span<const std::vector<TriangleOnRay>> hits,
                 std::span<const Aabb> boxes) override {
        const Recount second(*shape_, stored_, subject_->mesh, subject_->margin);
        const auto compare = [&](const TreeWork& walked, const TreeWork& expected, const char* query) {
            if (walked != expected)
                throw std::runtime_error(subject_->mesh.name + ", " + name() + ": two counters differ for a " + query);
        };
        for (std::size_t i = 0; i < rays.size(); ++i) {
            TreeWork work;
            static_cast<void>(walk_.closest(rays[i], work));
            compare(work, second.closest(rays[i], hits[i]), "ray");
        }
        for (const Aabb& box : boxes) {
            TreeWork work;
            static_cast<void>(walk_.count_touching(box, work));
            compare(work, second.touching(box), "box");
        }
    }
    [[nodiscard]] bool is_textbook() const override { return true; }

private:
    const LadderSubject* subject_;
    const TreeShape* shape_;
    StoredBoxes stored_;
    Tree tree_;
    TreeWalk<Tree> walk_;
};

template <class Tree>
std::unique_ptr<TreeSystem> make_textbook(const std::string& name, const LadderSubject& subject, const TreeShape& shape,
                                          StoredBoxes stored = {}) {
    return std::make_unique<TextbookSystem<Tree>>(name, subject, shape, stored);
}

}  // namespace

LadderShapes::LadderShapes(const LadderSubject& subject, unsigned leaf_triangles)
    : single(binary_shape(subject.binary, 1)), several(binary_shape(subject.binary, leaf_triangles)) {
    const std::vector<Aabb> boxes = boxes_of(several, subject.mesh.triangles, subject.mesh.positions);
    wide_4 = widened(several, boxes, 4);
    wide_8 = widened(several, boxes, 8);
    wide_16 = widened(several, boxes, 16);
}

TreeSystems ladder_systems(const LadderSubject& subject, const LadderShapes& shapes) {
    constexpr StoredBoxes no_leaves = {false, false}, quantised = {false, true};
    using NoLeaves = NoLeafTree<Aabb>;
    using Quantised = NoLeafTree<QuantisedBox>;
    TreeSystems systems;
    systems.push_back(make_textbook<CompleteTree>("complete", subject, shapes.single));
    systems.push_back(make_textbook<CompleteTree>("several a leaf", subject, shapes.several));
    systems.push_back(make_textbook<NoLeaves>("no leaf nodes", subject, shapes.single, no_leaves));
    systems.push_back(make_textbook<Quantised>("quantised", subject, shapes.single, quantised));
    systems.push_back(make_textbook<Quantised>("quantised, several a leaf", subject, shapes.several, quantised));
    systems.push_back(make_blob_system("espalier fast", subject.fast));
    systems.push_back(make_blob_system("espalier small", subject.small_blob));
    return systems;
}

TreeSystems degree_systems(const LadderSubject& subject, const LadderShapes& shapes) {
    TreeSystems systems;
    systems.push_back(make_textbook<WideTree<2>>("2", subject, shapes.several));
    systems.push_back(make_textbook<WideTree<4>>("4", subject, shapes.wide_4));
    systems.push_back(make_textbook<WideTree<8>>("8", subject, shapes.wide_8));
    systems.push_back(make_textbook<WideTree<16>>("16", subject, shapes.wide_16));
    systems.push_back(make_blob_system("espalier balanced", subject.balanced));
    systems.push_back(make_blob_system("espalier fast", subject.fast));
    return systems;
}

}  // namespace espalier::bench
