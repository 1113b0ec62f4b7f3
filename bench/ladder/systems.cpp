// Espalier's own queries among the trees that are compared.

#include "systems.hpp"

#include <baker/bake_with.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "../../tests/support/format/decoder.hpp"
#include "walk.hpp"

namespace espalier::bench {
namespace {

Box box_of(const Aabb& box) { return {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}}; }

bool do_touch(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

class BlobSystem final : public TreeSystem {
public:
    BlobSystem(const std::string& name, const BakedBlob& baked) : TreeSystem(name), baked_(&baked) {}

    [[nodiscard]] unsigned degree() const override { return format::max_node_children(baked_->blob.profile()); }
    [[nodiscard]] TreeBytes bytes() const override {
        const std::size_t node_bytes = format::node_bytes(baked_->blob.profile());
        return {detail::data_of(baked_->blob).node_count, node_bytes, baked_->baked.bytes.size()};
    }
    [[nodiscard]] float closest(const Ray& ray, TreeWork* work) override {
        if (work == nullptr) return raycast(baked_->blob, ray).t;
        QueryCounters counters;
        const float t = raycast(baked_->blob, ray, counters).t;
        *work += {counters.nodes, counters.leaves, 0, counters.triangles};
        return t;
    }
    /// Counts the nodes whose boxes the query meets: the library counts no overlaps.
    [[nodiscard]] std::uint64_t count_touching(const Aabb& box, TreeWork* work) override {
        std::uint64_t count = 0;
        const QueryStatus status = for_each_overlap(baked_->blob, box_of(box), [&](TriangleId) { ++count; });
        if (is_refused(status)) throw std::runtime_error(std::string("a box is refused: ") + describe(status));
        if (work != nullptr) *work += work_of(box_of(box));
        return count;
    }
    /// Compares the work of boxes with that of a loop over all nodes of a decoder that shares no code with the library.
    void recount(std::span<const Ray>, std::span<const std::vector<TriangleOnRay>>,
                 std::span<const Aabb> boxes) override {
        const tests::DecodedBlob decoded = tests::decode(baked_->baked.bytes);
        for (const Aabb& box : boxes)
            if (work_of(box_of(box)) != work_of(decoded, box))
                throw std::runtime_error(name() + ": two counters differ for a box");
    }
    [[nodiscard]] bool is_textbook() const override { return false; }

private:
    [[nodiscard]] TreeWork work_of(const Box& box) const {
        TreeWork work;
        std::vector<char> is_visited(detail::data_of(baked_->blob).node_count, 0);
        is_visited[0] = 1;
        static_cast<void>(for_each_node(baked_->blob, [&](const TreeNode& node) {
            if (!is_visited[node.number]) return NodeVisit::skip;
            work.count_node();
            for (unsigned i = 0; i < node.child_count; ++i) {
                const TreeChild& child = node.children[i];
                work.count_box();
                if (!do_touch(child.box, box)) continue;
                if (child.is_leaf) work.count_leaf(child.count);
                else is_visited[child.node] = 1;
            }
            return NodeVisit::descend;
        }));
        return work;
    }
    [[nodiscard]] static TreeWork work_of(const tests::DecodedBlob& decoded, const Aabb& box) {
        tests::GridBox query;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto steps = [&](float at) {
                return static_cast<std::int32_t>(
                    std::ldexp(double(at) - double(decoded.origin[k]), -decoded.step_exponent));
            };
            query.low[k] = steps(box.low[k]);
            query.high[k] = steps(box.high[k]);
        }
        TreeWork work;
        std::vector<char> is_visited(decoded.nodes.size(), 0);
        is_visited[0] = 1;
        for (std::size_t i = 0; i < decoded.nodes.size(); ++i) {  // children come after their parents
            if (!is_visited[i]) continue;
            work.nodes += 1;
            work.box_tests += decoded.nodes[i].children.size();
            for (const tests::DecodedChild& child : decoded.nodes[i].children) {
                bool is_apart = false;
                for (std::size_t k = 0; k < 3; ++k)
                    is_apart |= child.box.high[k] < query.low[k] || child.box.low[k] > query.high[k];
                if (is_apart) continue;
                if (child.is_node) is_visited[child.node] = 1;
                work.leaves += child.is_node ? 0u : 1u;
                work.triangle_tests += child.is_node ? 0u : child.triangle_count;
            }
        }
        return work;
    }
    const BakedBlob* baked_;
};

}  // namespace

std::unique_ptr<TreeSystem> make_blob_system(const std::string& name, const BakedBlob& baked) {
    return std::make_unique<BlobSystem>(name, baked);
}

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
    [[nodiscard]] float closest(const Ray& ray, TreeWork* work) override {
        NoWork none;
        return work != nullptr ? walk_.closest(ray, *work) : walk_.closest(ray, none);
    }
    [[nodiscard]] std::uint64_t count_touching(const Aabb& box, TreeWork* work) override {
        NoWork none;
        return work != nullptr ? walk_.count_touching(box, *work) : walk_.count_touching(box, none);
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

namespace {

/// The share of the largest coordinate by which a box is larger than its triangles.
constexpr float margin_share = 0x1p-19f;

/// Returns the triangles in the order of the tree, and the vertices in the order in which these use them first: what
/// lies together is near.
Mesh mesh_of_tree(const std::string& name, const baker::LatticeMesh& lattice_mesh, const baker::BinaryTree& binary) {
    constexpr std::uint32_t none = ~0u;
    const Vec3& origin = lattice_mesh.lattice.origin;
    const double step = lattice_mesh.lattice.step();
    const auto place = [&](float from, std::int32_t steps) { return static_cast<float>(double(from) + step * steps); };
    std::vector<std::uint32_t> renumbered(lattice_mesh.vertices.size(), none);
    Mesh mesh;
    mesh.name = name;
    for (const std::uint32_t number : binary.triangles) {
        TriangleVertices corners = lattice_mesh.triangles[number].corners;
        for (std::uint32_t& corner : corners) {
            std::uint32_t& vertex = renumbered[corner];
            if (vertex == none) {
                vertex = static_cast<std::uint32_t>(mesh.positions.size());
                const auto& p = lattice_mesh.vertices[corner];
                mesh.positions.push_back({place(origin.x, p.x), place(origin.y, p.y), place(origin.z, p.z)});
            }
            corner = vertex;
        }
        mesh.triangles.push_back(corners);
    }
    return mesh;
}

}  // namespace

BoxedShape LadderSubject::boxed(const TreeShape& shape) const {
    BoxedShape made{&shape, boxes_of(shape, mesh.triangles, mesh.positions)};
    for (Aabb& box : made.boxes)
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] -= margin;
            box.high[k] += margin;
        }
    return made;
}

LadderSubject make_subject(Mesh mesh) {
    bring_to_common_size(mesh);
    const MeshView view = mesh.view();
    const auto build = [](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        return baker::optimise(baker::build(lattice_mesh, Builder::binned_sah, settings),
                               baker::optimise_settings(Effort::normal));
    };
    LadderSubject made;
    const auto build_and_keep = [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        made.binary = build(lattice_mesh, settings);
        made.mesh = mesh_of_tree(mesh.name, lattice_mesh, made.binary);
        made.step = lattice_mesh.lattice.step();
        return build(lattice_mesh, settings);
    };
    made.fast = opened(mesh.name, baker::bake_with(build_and_keep, {&view, 1}, {.profile = Profile::fast}));
    made.balanced = bake_blob(mesh, Profile::balanced);
    made.small_blob = bake_blob(mesh, Profile::small);
    if (made.mesh.triangles.size() <= Link::most_triangles || made.mesh.triangles.size() > Link::most_first)
        throw std::runtime_error(mesh.name + ": too few triangles for a tree, or too many");
    made.margin = margin_share * largest_coordinate(made.mesh.positions);
    return made;
}

std::vector<Aabb> boxes_on_surface(const LadderSubject& subject, std::size_t count, std::uint64_t number) {
    const Mesh& mesh = subject.mesh;
    Aabb around = Aabb::none();
    for (const TriangleVertices& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) around.add(mesh.positions[vertex]);
    double side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) side = std::max(side, double(around.high[k]) - double(around.low[k]));
    const auto half = static_cast<float>(subject.step * std::max(1.0, std::floor(side / subject.step / 128.0)));
    tests::Random random(number);
    std::vector<Aabb> boxes;
    while (boxes.size() < count) {
        const TriangleVertices& triangle = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
        const Vec3& p = mesh.positions[triangle[random.below(3)]];
        boxes.push_back({{p.x - half, p.y - half, p.z - half}, {p.x + half, p.y + half, p.z + half}});
    }
    return boxes;
}

}  // namespace espalier::bench
