#include "box_trees.hpp"

#include <tuple>

#include "../volumes/pair_walk.hpp"
#include "fits.hpp"

namespace espalier::bench {

/// Encloses a placed AABB in one along the axes of the first tree, and tests three intervals (van den Bergen 1997).
class ReboxingPose : ByPlacement {
public:
    using Placed = StoredAabb;
    using ByPlacement::ByPlacement;
    [[nodiscard]] Placed placed(const StoredAabb& b) const {
        Placed moved;
        place(*placement_, b.center, moved.center);
        for (int i = 0; i < 3; ++i) moved.half[i] = dot3(placement_->magnitude[i], b.half);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredAabb& a, const Placed& b) const {
        for (int i = 0; i < 3; ++i)
            if (std::abs(b.center[i] - a.center[i]) > a.half[i] + b.half[i]) return false;
        return true;
    }
};

namespace {

double margin_of(const AabbTree& tree) { return stored_margin_share * static_cast<double>(tree.largest); }

/// Returns the box of a node; of a leaf, the least around its triangle.
Block fit_node(std::span<const Point> corners) {
    return fit_box(corners.size() == 3 ? BoxFit::flush : BoxFit::hull, corners);
}

class ObbBuilder {
public:
    explicit ObbBuilder(std::span<const FloatTriangle> triangles) {
        AabbTree& tree = built_.tree;
        tree.triangles.assign(triangles.begin(), triangles.end());
        for (const FloatTriangle& triangle : triangles)
            for (const Vec3& p : triangle)
                tree.largest = std::max({tree.largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        tree.nodes.reserve(2 * triangles.size());
        built_.boxes.reserve(2 * triangles.size());
        tree.nodes.resize(1);
        built_.boxes.resize(1);
        build(0, {0, triangles.size()}, 0);
    }
    [[nodiscard]] ObbTree take() { return std::move(built_); }

private:
    void build(std::size_t index, const TriangleRange& range, unsigned depth) {
        AabbTree& tree = built_.tree;
        tree.height = std::max(tree.height, depth);
        corners_ = corners_in(tree, range);
        const Block box = fit_node(corners_);
        store(box, margin_of(tree), built_.boxes[index]);
        store(box_along(Block{}.axes, corners_), margin_of(tree), tree.nodes[index]);
        const bool is_leaf = range.end - range.first == 1;
        const auto first = static_cast<std::uint32_t>(is_leaf ? range.first : tree.nodes.size());
        tree.nodes[index].first = built_.boxes[index].first = first;
        tree.nodes[index].count = built_.boxes[index].count = is_leaf ? 1 : 0;
        if (is_leaf) return;
        const std::size_t middle = divide(range, box);
        tree.nodes.resize(tree.nodes.size() + 2);
        built_.boxes.resize(tree.nodes.size());
        build(first, {range.first, middle}, depth + 1);
        build(first + 1, {middle, range.end}, depth + 1);
    }
    /// Reorders the triangles and returns where those of the second child begin.
    std::size_t divide(const TriangleRange& range, const Block& box) {
        Point mean = {0.0, 0.0, 0.0};
        for (const Point& corner : corners_) mean = mean + corner;
        mean = (1.0 / static_cast<double>(corners_.size())) * mean;
        std::array<std::size_t, 3> order = {0, 1, 2};
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return box.half[a] > box.half[b]; });
        const auto begin = built_.tree.triangles.begin();
        const auto first = begin + static_cast<std::ptrdiff_t>(range.first),
                   end = begin + static_cast<std::ptrdiff_t>(range.end);
        for (const std::size_t axis : order) {
            const double plane = 3.0 * dot(box.axes[axis], mean);
            const auto middle = std::stable_partition(first, end, [&](const FloatTriangle& t) {
                return dot(box.axes[axis], point_of(t[0]) + point_of(t[1]) + point_of(t[2])) < plane;
            });
            if (middle != first && middle != end) return static_cast<std::size_t>(middle - begin);
        }
        return (range.first + range.end) / 2;
    }

    ObbTree built_;
    std::vector<Point> corners_;
};

}  // namespace

ObbTree build_obb_tree(std::span<const FloatTriangle> triangles) { return ObbBuilder(triangles).take(); }

BoxNodes<StoredObb> fit_obbs(const AabbTree& tree) {
    BoxNodes<StoredObb> boxes(tree.nodes.size());
    const std::vector<TriangleRange> ranges = triangle_ranges(tree);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        store(fit_node(corners_in(tree, ranges[i])), margin_of(tree), boxes[i]);
        boxes[i].first = tree.nodes[i].first;
        boxes[i].count = tree.nodes[i].count;
    }
    return boxes;
}

namespace {

/// Returns a kind whose boxes `boxes_of` takes from the trees of a mesh.
template <class Pose, class Stored>
TreeKind kind_of(const char* topology, const char* boxes, NodesOfTree<Stored> (*boxes_of)(const MeshTrees&)) {
    return {topology, boxes, sizeof(VolumeNode<Stored>),
            [boxes_of](const MeshTrees& a, const MeshTrees& b, PairQuestion question) {
                auto walk = std::make_shared<VolumePairWalk<Pose, Stored>>(boxes_of(a), boxes_of(b));
                return [walk, question](const Transform& pose) { return walk->run(question, Placement(pose)); };
            }};
}

NodesOfTree<StoredObb> obbs_by_obbs(const MeshTrees& trees) { return {&trees.by_obbs.tree, trees.by_obbs.boxes}; }
NodesOfTree<StoredAabb> aabbs_by_obbs(const MeshTrees& trees) {
    return {&trees.by_obbs.tree, trees.by_obbs.tree.nodes};
}
NodesOfTree<StoredObb> obbs_by_sah(const MeshTrees& trees) { return {trees.sah, trees.sah_obbs}; }
NodesOfTree<StoredAabb> aabbs_by_sah(const MeshTrees& trees) { return {trees.sah, trees.sah->nodes}; }

}  // namespace

MeshTrees::MeshTrees(const AabbTree& of, BuildSeconds& seconds) : sah(&of) {
    const ProcessorTime time;
    by_obbs = build_obb_tree(of.triangles);
    seconds.obb_tree = time.seconds();
    sah_obbs = fit_obbs(of);
    seconds.fit = time.seconds() - seconds.obb_tree;
}

std::span<const TreeKind> all_tree_kinds() {
    static const std::vector<TreeKind> kinds = {
        kind_of<PreparedPose<StoredObb>>("obb", "obb", obbs_by_obbs),
        kind_of<PreparedPose<StoredAabb>>("obb", "aabb turned", aabbs_by_obbs),
        kind_of<ReboxingPose>("obb", "aabb reboxed", aabbs_by_obbs),
        kind_of<PreparedPose<StoredObb>>("sah", "obb", obbs_by_sah),
        kind_of<PreparedPose<StoredAabb>>("sah", "aabb turned", aabbs_by_sah),
        kind_of<ReboxingPose>("sah", "aabb reboxed", aabbs_by_sah),
    };
    return kinds;
}

namespace {

/// Returns a number for each position, which is the same for equal ones: a mesh may have several vertices at one place.
std::vector<std::uint32_t> places_of(std::span<const Vec3> positions) {
    std::vector<std::uint32_t> order(positions.size()), place(positions.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    const auto key = [&](std::uint32_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    for (std::size_t k = 0; k < order.size(); ++k)
        place[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? place[order[k - 1]] : order[k];
    return place;
}

}  // namespace

ParallelSurface parallel_surface_of(const Mesh& mesh, double gap) {
    ParallelSurface made;
    made.pose.rotation = {0.36f, -0.48f, 0.2f, 0.77f};
    const Matrix matrix = rotation_matrix(made.pose);
    const std::vector<std::uint32_t> place = places_of(mesh.positions);
    std::vector<Point> normals(mesh.positions.size(), Point{0.0, 0.0, 0.0});
    for (const TriangleVertices& triangle : mesh.triangles) {
        const Point a = point_of(mesh.positions[triangle[0]]);
        const Point across =
            cross(point_of(mesh.positions[triangle[1]]) - a, point_of(mesh.positions[triangle[2]]) - a);
        for (const std::uint32_t vertex : triangle) normals[place[vertex]] = normals[place[vertex]] + across;
    }
    made.mesh = mesh;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Point& normal = normals[place[i]];
        const double length = std::sqrt(dot(normal, normal));
        const Point moved = point_of(mesh.positions[i]) + (length > 0.0 ? gap / length : 0.0) * normal;
        const double from[3] = {moved.x, moved.y, moved.z};
        float to[3];
        for (int k = 0; k < 3; ++k)  // the inverse of a rotation is its transpose
            to[k] =
                static_cast<float>(matrix.at[0][k] * from[0] + matrix.at[1][k] * from[1] + matrix.at[2][k] * from[2]);
        made.mesh.positions[i] = {to[0], to[1], to[2]};
    }
    return made;
}

}  // namespace espalier::bench
