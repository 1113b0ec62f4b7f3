#include "aabb_tree.hpp"

#include <baker/bake_with.hpp>
#include <baker/build/build.hpp>
#include <baker/optimise/reinsertion.hpp>

namespace espalier::bench {
namespace {

/// The share of the largest coordinate by which a box is larger than its triangles.
constexpr float margin_share = 0x1p-19f;

class Maker {
public:
    Maker(const Mesh& mesh, const baker::LatticeMesh& lattice_mesh, const baker::BinaryTree& binary, unsigned most)
        : binary_(binary), most_(most) {
        tree_.largest = largest_coordinate(mesh.positions);
        tree_.triangles.reserve(binary.triangles.size());
        for (const std::uint32_t number : binary.triangles) {
            tree_.triangles.push_back(triangle_of(mesh, mesh.triangles[lattice_mesh.triangles[number].original_id]));
        }
        tree_.nodes.emplace_back();
        fill(0, 0, 0);
    }
    [[nodiscard]] AabbTree take() { return std::move(tree_); }

private:
    void fill(std::size_t index, std::size_t source, unsigned depth) {
        const baker::BinaryNode& node = binary_.nodes[source];
        put_box(tree_.nodes[index], std::span(tree_.triangles).subspan(node.first, node.count));
        tree_.height = std::max(tree_.height, depth);
        if (node.count <= most_) {
            tree_.nodes[index].first = node.first;
            tree_.nodes[index].count = node.count;
            return;
        }
        const std::size_t children = tree_.nodes.size();
        tree_.nodes[index].first = static_cast<std::uint32_t>(children);
        tree_.nodes[index].count = 0;
        tree_.nodes.resize(children + 2);
        fill(children, baker::BinaryTree::left_of(source), depth + 1);
        fill(children + 1, binary_.right_of(source), depth + 1);
    }
    void put_box(AabbNode& node, std::span<const FloatTriangle> triangles) const {
        Aabb box = Aabb::none();
        for (const FloatTriangle& triangle : triangles)
            for (const Vec3& corner : triangle) box.add(corner);
        for (std::size_t k = 0; k < 3; ++k) {
            node.center[k] = 0.5f * (box.low[k] + box.high[k]);
            node.half[k] = 0.5f * (box.high[k] - box.low[k]) + margin_share * tree_.largest;
        }
    }

    const baker::BinaryTree& binary_;
    unsigned most_;
    AabbTree tree_;
};

}  // namespace

std::vector<TriangleRange> triangle_ranges(const AabbTree& tree) {
    // Children come after their parent, so that their ranges are there when its own is joined.
    std::vector<TriangleRange> ranges(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const AabbNode& node = tree.nodes[i];
        if (node.is_leaf()) ranges[i] = {node.first, std::size_t{node.first} + node.count};
        else ranges[i] = {ranges[node.first].first, ranges[node.first + 1].end};
    }
    return ranges;
}

TreeAndBlob build_tree_and_blob(const Mesh& mesh, unsigned most_leaf_triangles) {
    TreeAndBlob made;
    const auto make = [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        const ProcessorTime time;
        baker::BinaryTree binary = baker::optimise(baker::build(lattice_mesh, Builder::binned_sah, settings),
                                                   baker::optimise_settings(Effort::normal));
        made.build_seconds = time.seconds();
        if (!binary.triangles.empty()) made.tree = Maker(mesh, lattice_mesh, binary, most_leaf_triangles).take();
        made.tree_seconds = time.seconds();
        return binary;
    };
    const MeshView view = mesh.view();
    made.baked = opened(mesh.name, baker::bake_with(make, {&view, 1}, {.profile = Profile::fast}));
    if (made.tree.nodes.empty()) throw std::runtime_error(mesh.name + ": there are no triangles");
    return made;
}

namespace {

using Heights = std::array<double, 3>;

/// More than the share of the largest coordinate that double rounds off in a height.
constexpr double rounding_share = 0x1p-46;

double length_of(const Point& normal) { return std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z); }

Point normal_of(const Corners3& t) { return cross(t[1] - t[0], t[2] - t[0]); }

Heights heights_above(const Point& normal, double plane, const Corners3& corners) {
    return {dot(normal, corners[0]) - plane, dot(normal, corners[1]) - plane, dot(normal, corners[2]) - plane};
}

bool are_on_one_side(const Heights& heights, double slack) {
    return std::min({heights[0], heights[1], heights[2]}) > slack ||
           std::max({heights[0], heights[1], heights[2]}) < -slack;
}

bool is_one_uncertain(const Heights& heights, double slack) {
    return std::min({std::abs(heights[0]), std::abs(heights[1]), std::abs(heights[2])}) <= slack;
}

/// Returns the corner whose height has another sign than those of the other two.
std::size_t corner_alone(const Heights& heights) {
    const bool is_0_above = heights[0] > 0.0, is_1_above = heights[1] > 0.0, is_2_above = heights[2] > 0.0;
    if (is_1_above == is_2_above) return 0;
    return is_0_above == is_2_above ? 1 : 2;
}

Corners3 turned_to(std::size_t first, const Corners3& t) { return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]}; }

/// Tests two triangles that cross each other's planes: the segments in which they meet the common line of the planes.
bool do_segments_touch(Corners3 p, const Heights& of_p, Corners3 q, const Heights& of_q) {
    const std::size_t p_alone = corner_alone(of_p), q_alone = corner_alone(of_q);
    p = turned_to(p_alone, p);
    q = turned_to(q_alone, q);
    if (of_p[p_alone] < 0.0) std::swap(q[1], q[2]);
    if (of_q[q_alone] < 0.0) std::swap(p[1], p[2]);
    if (dot(q[1] - p[1], cross(q[0] - p[1], p[0] - p[1])) > 0.0) return false;
    return dot(q[2] - p[0], cross(q[0] - p[0], p[2] - p[0])) <= 0.0;
}

}  // namespace

PlacedTriangle::PlacedTriangle(const FloatTriangle& triangle, const Pose& pose, double largest)
    : corners_(corners_of(triangle)), rounding_(rounding_share * largest) {
    for (Point& corner : corners_) corner = pose(corner);
    normal_ = normal_of(corners_);
    height_ = dot(normal_, corners_[0]);
    slack_ = rounding_ * length_of(normal_);
}

bool PlacedTriangle::touches(const FloatTriangle& triangle) const {
    const Corners3 other = corners_of(triangle);
    const Heights of_other = heights_above(normal_, height_, other);
    if (are_on_one_side(of_other, slack_)) return false;
    const Point normal = normal_of(other);
    const Heights of_this = heights_above(normal, dot(normal, other[0]), corners_);
    const double other_slack = rounding_ * length_of(normal);
    if (are_on_one_side(of_this, other_slack)) return false;
    if (is_one_uncertain(of_other, slack_) || is_one_uncertain(of_this, other_slack)) return touch(other, corners_);
    return do_segments_touch(other, of_other, corners_, of_this);
}

}  // namespace espalier::bench
