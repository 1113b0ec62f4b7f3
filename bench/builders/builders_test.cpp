// Claims about the builders that are compared: each tree holds each triangle in boxes that hold it, answers as the loop
// over all triangles does, and is what its rule says.
#include <doctest/doctest.h>

#include <baker/build/build.hpp>
#include <baker/build/sah_split.hpp>

#include "../../tests/baker/build/tree_support.hpp"
#include "../../tests/support/answers/differences.hpp"
#include "../../tests/support/format/decoder.hpp"
#include "../../tests/support/queries/ray_maker.hpp"
#include "../../tools/layout/tree_quality.hpp"
#include "bakes.hpp"
#include "builders.hpp"

using namespace espalier;
using namespace espalier::bench;

namespace {

baker::LaneBox box_of(const baker::LatticeMesh& mesh, std::uint32_t triangle) {
    baker::Reference unused;
    return baker::put_reference(mesh, triangle, unused);
}

bool is_inside(const baker::LaneBox& inner, const baker::LaneBox& outer) {
    for (int axis = 0; axis < 3; ++axis)
        if (inner.lo[axis] < outer.lo[axis] || inner.hi[axis] > outer.hi[axis]) return false;
    return true;
}

bool is_same(const baker::LaneBox& a, const baker::LaneBox& b) { return is_inside(a, b) && is_inside(b, a); }

/// Checks that each triangle is in one leaf, or in several whose boxes together reach as far as the triangle, and that
/// each node's box is the one around its children. Returns the height.
unsigned checked_tree(const baker::LatticeMesh& mesh, const baker::BinaryTree& tree, bool may_repeat) {
    std::vector<unsigned> times(mesh.triangles.size());
    std::vector<baker::LaneBox> boxes(mesh.triangles.size());
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const baker::BinaryNode& node = tree.nodes[i];
        if (!node.is_leaf()) continue;
        const std::uint32_t triangle = tree.triangles.at(node.first);
        ++times.at(triangle);
        boxes[triangle].add(node.box());
    }
    std::size_t wrong_times = 0;
    std::size_t wrong_boxes = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (may_repeat ? times[i] == 0 : times[i] != 1) ++wrong_times;
        if (!is_same(boxes[i], box_of(mesh, i))) ++wrong_boxes;
    }
    REQUIRE(wrong_times == 0);
    REQUIRE(wrong_boxes == 0);
    REQUIRE(tree.nodes[0].count == tree.triangles.size());
    return tests::checked_height(tree, 0);
}

void check_answers(const Bakes& bakes, const baker::BinaryTree& tree) {
    const TimedBlob built = bakes.bake(tree);
    const tests::DecodedBlob decoded = tests::decode(built.baked.bytes);
    const tests::TriangleLoop loop(decoded);
    tests::QueryMaker maker(decoded, 500);
    std::uint64_t hits = 0;
    for (int i = 0; i < 60; ++i) {
        const auto difference = tests::ray_difference(built.blob, loop, maker.any_ray(), hits);
        REQUIRE_MESSAGE(!difference, *difference);
    }
    CHECK(hits > 0);
    std::uint64_t found = 0;
    for (int i = 0; i < 30; ++i) {
        const auto difference = tests::sphere_difference(built.blob, loop, maker.sphere(), found);
        REQUIRE_MESSAGE(!difference, *difference);
    }
    CHECK(found > 0);
}

/// One triangle for each interval of an axis, from its first to its second number, as thick as 10 steps.
baker::LatticeMesh row_of(const std::vector<std::array<std::int32_t, 2>>& intervals) {
    baker::LatticeMesh mesh;
    mesh.lattice.bits = 16;
    for (const auto& [from, to] : intervals) tests::add_triangle(mesh, {from, 0, 0}, {to, 10, 0}, {from, 0, 10});
    return mesh;
}

/// Returns how many triangles the root's left child has.
std::uint32_t left_count(const baker::BinaryTree& tree) { return tree.nodes[1].count; }

const baker::BuildSettings settings = baker::build_settings(Effort::normal, 1);

}  // namespace

TEST_SUITE("builders") {
    TEST_CASE("bench: every builder makes a sound tree whose blob answers as the loop does") {
        for (tests::Mesh mesh : {tests::make_terrain(14, 1), tests::make_soup(400, 4), tests::make_needle_fan(200),
                                 tests::make_coplanar_stacks(300, 2), tests::crossed_by_beams(20, 300, 1)}) {
            const Bakes bakes(std::move(mesh));
            for (const NamedBuilder& builder : all_builders()) {
                CAPTURE(builder.name);
                const bool may_repeat = builder.name == "spatial splits";
                const baker::BinaryTree built = builder.build(bakes.lattice_mesh(), bakes.settings());
                const TimedTree moved = bakes.reinsert(built);
                for (const baker::BinaryTree* tree : {&built, &moved.tree}) {
                    CHECK(checked_tree(bakes.lattice_mesh(), *tree, may_repeat) == quality_of(*tree).height);
                    CHECK(quality_of(*tree).height <= baker::max_binary_height);
                    check_answers(bakes, *tree);
                }
            }
        }
    }

    TEST_CASE("bench: the rules of the textbook yield to balance where a tree would become too high") {
        for (const baker::LatticeMesh& mesh :
             {tests::exponential_stairs(40), tests::nearly_equal_boxes(500), tests::identical_triangles(300)}) {
            for (const NamedBuilder& builder : all_builders()) {
                if (builder.family != "objective" && builder.family != "split point") continue;
                CAPTURE(builder.name);
                baker::BuildSettings low = settings;
                low.most_height = baker::balanced_height(static_cast<std::uint32_t>(mesh.triangles.size())) + 1;
                CHECK(checked_tree(mesh, builder.build(mesh, low), false) <= low.most_height);
                checked_tree(mesh, builder.build(mesh, settings), false);
            }
        }
    }

    TEST_CASE("bench: a split point lies where its rule puts it") {
        // The median of the centres lies at 50 or above, their mean at 55.2 and the middle of their box at 50.
        const baker::LatticeMesh mesh = row_of({{0, 0}, {30, 30}, {50, 50}, {51, 51}, {100, 100}, {100, 100}});
        const auto split = [&](SplitPoint point) {
            return left_count(build_at_points(mesh, SplitAxis::longest_side, point, settings));
        };
        CHECK(split(SplitPoint::object_median) == 3);
        CHECK(split(SplitPoint::object_mean) == 4);
        CHECK(split(SplitPoint::spatial_median) == 2);
    }

    TEST_CASE("bench: an objective splits a row of triangles where its rule puts it") {
        // The greatest gap is before the last triangle, the second greatest one in the middle.
        const baker::LatticeMesh mesh =
            row_of({{0, 400}, {420, 430}, {440, 450}, {455, 460}, {600, 605}, {610, 615}, {620, 625}, {1000, 1010}});
        const auto split = [&](Objective objective) {
            return left_count(build_by_objective(mesh, objective, settings));
        };
        CHECK(split(Objective::separation) == 7);
        CHECK(split(Objective::sum_of_areas) == 7);
        CHECK(split(Objective::sum_of_volumes) == 7);
        CHECK(split(Objective::maximum_area) == 4);
        CHECK(split(Objective::intersection_area) == 4);
        CHECK(split(Objective::bounded_sum_of_areas) == 4);
        CHECK(split(Objective::weighted_sum_of_areas) == 4);
    }

    TEST_CASE("bench: a sum of volumes joins flat triangles far apart and a sum of areas does not") {
        baker::LatticeMesh mesh;
        mesh.lattice.bits = 16;
        tests::add_triangle(mesh, {0, 0, 0}, {0, 10, 0}, {0, 0, 10});        // flat
        tests::add_triangle(mesh, {0, 990, 0}, {0, 1000, 0}, {0, 990, 10});  // in the plane of the first
        tests::add_triangle(mesh, {5, 0, 0}, {15, 10, 0}, {5, 0, 10});       // beside the first
        const auto alone = [&](Objective objective) {
            return build_by_objective(mesh, objective, settings).triangles[2];
        };
        CHECK(alone(Objective::sum_of_volumes) == 2);
        CHECK(alone(Objective::sum_of_areas) == 1);
    }

    TEST_CASE("bench: the weighted sum of areas makes trees as good as the full sweep of the library") {
        for (const baker::LatticeMesh& mesh : {tests::mixed_sizes(3'000, 1), tests::mixed_sizes(3'000, 2)}) {
            const double ours =
                quality_of(build_by_objective(mesh, Objective::weighted_sum_of_areas, settings)).sah_cost();
            const double theirs = quality_of(baker::build(mesh, Builder::sweep_sah, settings)).sah_cost();
            CHECK(ours == doctest::Approx(theirs).epsilon(0.002));
        }
    }
}

TEST_CASE("bench: the quality of the tree of a blob is that of its decoded nodes") {
    const auto half_area = [](const tests::GridBox& box) {
        double sides[3];
        for (std::size_t k = 0; k < 3; ++k) sides[k] = double(box.high[k]) - double(box.low[k]);
        if (sides[0] < 0.0 || sides[1] < 0.0 || sides[2] < 0.0) return 0.0;
        return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
    };
    const auto common = [](const tests::GridBox& a, const tests::GridBox& b) {
        tests::GridBox box = a;
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::max(a.low[k], b.low[k]);
            box.high[k] = std::min(a.high[k], b.high[k]);
        }
        return box;
    };
    for (const tests::Mesh& mesh :
         {tests::make_torus(40, 20, 2.0, 0.6), tests::make_terrain(30, 2), tests::make_soup(500, 3)}) {
        const Bakes bakes(mesh);
        const TimedBlob built = bakes.bake(bakes.build(all_builders().front(), 1).tree);
        const tools::TreeQuality quality = tools::tree_quality_of(built.blob);
        const tests::DecodedBlob decoded = tests::decode(built.baked.bytes);
        tests::GridBox whole = decoded.nodes[0].children[0].box;
        for (const tests::DecodedChild& child : decoded.nodes[0].children)
            for (std::size_t k = 0; k < 3; ++k) {
                whole.low[k] = std::min(whole.low[k], child.box.low[k]);
                whole.high[k] = std::max(whole.high[k], child.box.high[k]);
            }
        double nodes = 0.0, leaves = 0.0, triangles = 0.0, shared = 0.0, depths = 0.0, leaf_count = 0.0,
               triangle_count = 0.0;
        for (const tests::DecodedNode& node : decoded.nodes)
            for (std::size_t i = 0; i < node.children.size(); ++i) {
                const tests::DecodedChild& child = node.children[i];
                const double area = half_area(child.box) / half_area(whole);
                (child.is_node ? nodes : leaves) += area;
                for (std::size_t j = 0; j < i; ++j)
                    shared += half_area(common(child.box, node.children[j].box)) / half_area(whole);
                if (child.is_node) continue;
                triangles += area * child.triangle_count;
                triangle_count += child.triangle_count;
                depths += node.depth;
                ++leaf_count;
            }
        const auto is_near = [](double a, double b) { return std::abs(a - b) <= 1e-4 * (1.0 + std::abs(b)); };
        CHECK(is_near(quality.all.node_areas, nodes));
        CHECK(is_near(quality.all.leaf_areas, leaves));
        CHECK(is_near(quality.triangle_areas, triangles));
        CHECK(is_near(quality.all.shared_areas, shared));
        CHECK(is_near(quality.mean_leaf_depth, depths / leaf_count));
        CHECK(static_cast<double>(quality.all.leaves) == leaf_count);
        CHECK(static_cast<double>(quality.all.triangles) == triangle_count);
        CHECK(quality.levels.size() == built.blob.depth());
        double by_size = 0.0;
        for (std::size_t size = 0; size < quality.leaves_of_size.size(); ++size)
            by_size += static_cast<double>(size * quality.leaves_of_size[size]);
        CHECK(by_size == triangle_count);
    }
}
