// Claims about shapes, layouts and counters of trees.
#include <doctest/doctest.h>

#include "../study/some_meshes.hpp"
#include "systems.hpp"
#include "walk.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

constexpr unsigned leaf_triangles = 3;

double inner_areas(const TreeShape& shape, const std::vector<Aabb>& boxes) {
    double sum = 0.0;
    for (std::size_t i = 0; i < boxes.size(); ++i) sum += shape.nodes[i].is_leaf() ? 0.0 : boxes[i].half_area();
    return sum;
}

/// Returns the sum of the inner nodes' areas where each node takes the grandchildren in place of the largest child
/// until it has `degree` children.
double greedy_areas(const TreeShape& binary, const std::vector<Aabb>& boxes, std::size_t node, unsigned degree) {
    if (binary.nodes[node].is_leaf()) return 0.0;
    std::vector<std::size_t> children = {node};
    while (children.size() < degree) {
        const auto area = [&](std::size_t child) {
            return binary.nodes[child].is_leaf() ? -1.0 : boxes[child].half_area();
        };
        const auto largest = std::max_element(children.begin(), children.end(),
                                              [&](std::size_t a, std::size_t b) { return area(a) < area(b); });
        if (area(*largest) < 0.0) break;
        const std::size_t first = binary.nodes[*largest].first_child;
        *largest = first;
        children.push_back(first + 1);
    }
    double sum = boxes[node].half_area();
    for (const std::size_t child : children) sum += greedy_areas(binary, boxes, child, degree);
    return sum;
}

}  // namespace

TEST_CASE("bench: shapes of every degree have the same leaves and few enough children") {
    for (const Mesh& source : some_meshes()) {
        const LadderSubject subject = make_subject(source);
        const TreeShape binary = binary_shape(subject.binary, leaf_triangles);
        const std::vector<Aabb> boxes = boxes_of(binary, subject.mesh.triangles, subject.mesh.positions);
        double most = inner_areas(binary, boxes);
        for (const unsigned degree : {2u, 3u, 4u, 8u, 16u}) {
            CAPTURE(degree);
            const TreeShape shape = widened(binary, boxes, degree);
            std::size_t leaves = 0;
            for (std::size_t i = 0; i < shape.nodes.size(); ++i) {
                const ShapeNode& node = shape.nodes[i];
                if (i > 0) CHECK(node.parent < i);
                if (node.is_leaf()) {
                    CHECK(node.count <= leaf_triangles);
                    ++leaves;
                    continue;
                }
                CHECK(node.child_count >= 2);
                CHECK(node.child_count <= degree);
                std::uint32_t next = node.first;
                for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
                    CHECK(shape.nodes[k].parent == i);
                    CHECK(shape.nodes[k].first == next);
                    next += shape.nodes[k].count;
                }
                CHECK(next == node.first + node.count);
            }
            CHECK(leaves == binary.nodes.size() - binary.inner_count());
            if (degree == 2) CHECK(shape.nodes.size() == binary.nodes.size());
            // Fewer expected visits than with a lower degree, and than a greedy choice has.
            const double areas = inner_areas(shape, boxes_of(shape, subject.mesh.triangles, subject.mesh.positions));
            CHECK(areas <= most);
            CHECK(areas <= greedy_areas(binary, boxes, 0, degree) * (1.0 + 1e-12));
            most = areas;
        }
    }
}

TEST_CASE("bench: quantised boxes contain the boxes that they are rounded from and little more") {
    for (const Mesh& source : some_meshes()) {
        const LadderSubject subject = make_subject(source);
        const TreeShape shape = binary_shape(subject.binary, 1);
        const BoxedShape boxed = subject.boxed(shape);
        const BoxGrid grid(boxed.boxes[0]);
        std::size_t outside = 0;
        for (const Aabb& box : boxed.boxes) {
            const Aabb rounded = grid.box_of(grid.rounded(box));
            for (std::size_t k = 0; k < 3; ++k)
                outside += rounded.low[k] > box.low[k] || rounded.high[k] < box.high[k] ||
                                   box.low[k] - rounded.low[k] > grid.step || rounded.high[k] - box.high[k] > grid.step
                               ? 1u
                               : 0u;
        }
        CHECK(outside == 0);
        CHECK(grid.step * 65'536.0f >= boxed.boxes[0].high[0] - boxed.boxes[0].low[0]);
    }
}

TEST_CASE("bench: every layout has the answers of a loop over all triangles and equal counts by two counters") {
    for (const Mesh& source : some_meshes()) {
        const LadderSubject subject = make_subject(source);
        const LadderShapes shapes(subject, leaf_triangles);
        const std::vector<Ray> rays = incoherent_rays(subject.mesh, 300, 3);
        const std::vector<Aabb> boxes = boxes_on_surface(subject, 300, 3);
        std::vector<std::vector<TriangleOnRay>> hits;
        const std::vector<FloatTriangle> triangles = triangles_of(subject.mesh);
        std::vector<float> nearest;
        std::vector<std::uint64_t> touching;
        for (const Ray& ray : rays) {
            hits.push_back(triangles_on(ray, subject.mesh));
            nearest.push_back(no_hit);
            for (const TriangleOnRay& hit : hits.back()) nearest.back() = std::min(nearest.back(), hit.t);
        }
        for (const Aabb& box : boxes) touching.push_back(touching_of_all(triangles, box));
        CHECK(*std::max_element(touching.begin(), touching.end()) > 1);
        for (const auto& systems : {ladder_systems(subject, shapes), degree_systems(subject, shapes)})
            for (const auto& system : systems) {
                CAPTURE(subject.mesh.name);
                CAPTURE(system->name());
                CHECK_NOTHROW(system->recount(rays, hits, boxes));
                std::vector<float> found;
                std::vector<std::uint64_t> counts;
                for (const Ray& ray : rays) found.push_back(system->closest(ray, nullptr));
                for (const Aabb& box : boxes) counts.push_back(system->count_touching(box, nullptr));
                CHECK(counts == touching);
                if (system->is_textbook()) CHECK(found == nearest);
            }
    }
}

TEST_CASE("bench: the second counter has other counts for another layout") {
    const LadderSubject subject = make_subject(tests::make_torus(24, 10, 2.0, 0.6));
    const TreeShape shape = binary_shape(subject.binary, 1);
    const NoLeafTree<Aabb> tree(subject.boxed(shape));
    TreeWalk walk(tree, subject.mesh, shape.height);
    const Recount same(shape, {false, false}, subject.mesh, subject.margin);
    const Recount with_leaves(shape, {true, false}, subject.mesh, subject.margin);
    const Recount larger(shape, {false, false}, subject.mesh, 4.0f);
    std::size_t as_with_leaves = 0, as_larger = 0;
    const std::vector<Ray> rays = incoherent_rays(subject.mesh, 200, 5);
    for (const Ray& ray : rays) {
        const std::vector<TriangleOnRay> hits = triangles_on(ray, subject.mesh);
        TreeWork work;
        static_cast<void>(walk.closest(ray, work));
        CHECK(work == same.closest(ray, hits));
        as_with_leaves += work == with_leaves.closest(ray, hits) ? 1u : 0u;
        as_larger += work == larger.closest(ray, hits) ? 1u : 0u;
    }
    CHECK(as_with_leaves < rays.size() / 2);
    CHECK(as_larger < rays.size() / 2);
}
