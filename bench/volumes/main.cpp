// Which bounding volume? The same binary trees with spheres, axis-aligned boxes, oriented boxes and 26-DOPs: how much
// surface and space they take, and how many tests a query makes. Counts, the same on every machine.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <baker/bake_with.hpp>
#include <baker/build/build.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "../../tests/support/base/random.hpp"
#include "../../tests/support/meshes/files.hpp"
#include "../program.hpp"
#include "../rays.hpp"
#include "shapes.hpp"
#include "tests.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

constexpr std::uint64_t seed = 2026;
constexpr unsigned max_leaf_triangles = 8;
constexpr std::size_t query_count = 10'000;
constexpr std::size_t pose_count = 200;
constexpr const char* kind_names[] = {"sphere", "aligned box", "oriented box", "26-DOP"};
constexpr int numbers_stored[] = {4, 6, 15, 26};

struct TreeNode {
    Volumes volumes;
    std::size_t children[2] = {0, 0};  ///< 0: a leaf
    std::size_t first = 0;
    std::size_t count = 0;
};

struct Tree {
    std::vector<TreeNode> nodes;
    std::vector<Corners3> triangles;
    Point low{};
    Point high{};
};

/// The baker's binary tree, in lattice steps, down to leaves of a few triangles.
Tree make_tree(const Mesh& mesh) {
    Tree made;
    const auto keep = [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        auto tree = baker::optimise(baker::build(lattice_mesh, Builder::binned_sah, settings),
                                    baker::optimise_settings(Effort::normal));
        for (const std::uint32_t number : tree.triangles) {
            Corners3 corners;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& p = lattice_mesh.vertices[lattice_mesh.triangles[number].corners[k]];
                corners[k] = {double(p.x), double(p.y), double(p.z)};
            }
            made.triangles.push_back(corners);
        }
        const std::function<std::size_t(std::size_t)> add = [&](std::size_t binary) {
            const std::size_t index = made.nodes.size();
            made.nodes.emplace_back();
            const baker::BinaryNode& node = tree.nodes[binary];
            std::vector<Point> points;
            for (std::size_t i = 0; i < node.count; ++i)
                points.insert(points.end(), made.triangles[node.first + i].begin(),
                              made.triangles[node.first + i].end());
            made.nodes[index].volumes = fit_volumes(points);
            made.nodes[index].first = node.first;
            made.nodes[index].count = node.count;
            if (node.count > max_leaf_triangles) {
                const std::size_t left = add(baker::BinaryTree::left_of(binary));
                const std::size_t right = add(tree.right_of(binary));
                made.nodes[index].children[0] = left;
                made.nodes[index].children[1] = right;
            }
            return index;
        };
        if (!made.triangles.empty()) add(0);
        return tree;
    };
    const MeshView view = mesh.view();
    const auto baked = baker::bake_with(keep, {&view, 1}, {});
    if (!baked) throw std::runtime_error(baked.message);
    if (made.nodes.empty()) throw std::runtime_error("the mesh has no triangles");
    const Block& all = made.nodes[0].volumes.aligned;
    const Point half = {all.half[0], all.half[1], all.half[2]};
    made.low = all.center - half;
    made.high = all.center + half;
    return made;
}

struct Counts {
    std::uint64_t volumes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t answers = 0;
};

Point point_in(const Tree& tree, tests::Random& random, double margin) {
    const auto at = [&](double low, double high) {
        return low - margin * (high - low) + (1.0 + 2.0 * margin) * (high - low) * double(random.unit());
    };
    const double x = at(tree.low.x, tree.high.x);
    const double y = at(tree.low.y, tree.high.y);
    return {x, y, at(tree.low.z, tree.high.z)};
}

/// The closest hit, nearer children first.
void walk_ray(const Tree& tree, Kind kind, const Line& line, std::size_t index, double& nearest, Counts& counts) {
    const TreeNode& node = tree.nodes[index];
    if (node.children[0] == 0) {
        for (std::size_t i = 0; i < node.count; ++i) {
            ++counts.triangles;
            if (const auto at = meets(tree.triangles[node.first + i], line)) nearest = std::min(nearest, *at);
        }
        return;
    }
    counts.volumes += 2;
    std::array<std::pair<double, std::size_t>, 2> order;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto at = entry(kind, tree.nodes[node.children[k]].volumes, line);
        order[k] = {at.value_or(std::numeric_limits<double>::infinity()), node.children[k]};
    }
    if (order[1].first < order[0].first) std::swap(order[0], order[1]);
    for (const auto& [at, child] : order)
        if (at <= nearest && at < std::numeric_limits<double>::infinity())
            walk_ray(tree, kind, line, child, nearest, counts);
}

void walk_ball(const Tree& tree, Kind kind, const Ball& ball, std::size_t index, Counts& counts) {
    const TreeNode& node = tree.nodes[index];
    if (node.children[0] == 0) {
        for (std::size_t i = 0; i < node.count; ++i) {
            ++counts.triangles;
            counts.answers += touches(tree.triangles[node.first + i], ball) ? 1u : 0u;
        }
        return;
    }
    for (const std::size_t child : node.children) {
        ++counts.volumes;
        if (touches(kind, tree.nodes[child].volumes, ball)) walk_ball(tree, kind, ball, child, counts);
    }
}

/// Whether the mesh touches itself in the pose. Of two nodes the one with the larger aligned box is opened.
bool walk_pair(const Tree& tree, Kind kind, const Pose& pose, std::size_t a, std::size_t b, Counts& counts) {
    const TreeNode& node_a = tree.nodes[a];
    const TreeNode& node_b = tree.nodes[b];
    ++counts.volumes;
    if (!touch(kind, node_a.volumes, node_b.volumes, pose)) return false;
    constexpr auto aligned = static_cast<std::size_t>(Kind::aligned_box);
    if (node_a.children[0] == 0 && node_b.children[0] == 0) {
        for (std::size_t j = 0; j < node_b.count; ++j) {
            Corners3 moved = tree.triangles[node_b.first + j];
            for (Point& p : moved) p = pose(p);
            for (std::size_t i = 0; i < node_a.count; ++i) {
                ++counts.triangles;
                if (touch(tree.triangles[node_a.first + i], moved)) return true;
            }
        }
        return false;
    }
    const bool open_a = node_b.children[0] == 0 ||
                        (node_a.children[0] != 0 && node_a.volumes.areas[aligned] >= node_b.volumes.areas[aligned]);
    for (const std::size_t child : (open_a ? node_a : node_b).children)
        if (open_a ? walk_pair(tree, kind, pose, child, b, counts) : walk_pair(tree, kind, pose, a, child, counts))
            return true;
    return false;
}

/// Rotations uniform (Shoemake 1992); the second mesh's middle lies in a random direction from the first one's.
std::vector<Pose> some_poses(const Tree& tree, double distance) {
    tests::Random random(seed);
    const Point middle = 0.5 * (tree.low + tree.high);
    std::vector<Pose> poses;
    while (poses.size() < pose_count) {
        double q[4];
        double length = 0.0;
        for (double& part : q) {
            part = double(random.signed_unit());
            length += part * part;
        }
        const Point out = {double(random.signed_unit()), double(random.signed_unit()), double(random.signed_unit())};
        const double reach = std::sqrt(dot(out, out));
        if (length > 1.0 || length < 0.01 || reach > 1.0 || reach < 0.1) continue;
        const double w = q[0], x = q[1], y = q[2], z = q[3], n = 1.0 / length;
        Pose pose;
        pose.rotation = {{{n * (w * w + x * x - y * y - z * z), n * 2 * (x * y - w * z), n * 2 * (x * z + w * y)},
                          {n * 2 * (x * y + w * z), n * (w * w - x * x + y * y - z * z), n * 2 * (y * z - w * x)},
                          {n * 2 * (x * z - w * y), n * 2 * (y * z + w * x), n * (w * w - x * x - y * y + z * z)}}};
        pose.shift = {0, 0, 0};
        pose.shift = middle + (distance / reach) * out - pose(middle);
        poses.push_back(pose);
    }
    return poses;
}

/// As far apart as makes about half of the poses touch.
std::vector<Pose> balanced_poses(const Tree& tree) {
    const Point side = tree.high - tree.low;
    double near = 0.0;
    double far = std::sqrt(dot(side, side));
    for (int i = 0; i < 12; ++i) {
        const double distance = 0.5 * (near + far);
        std::size_t touching = 0;
        Counts ignored;
        for (const Pose& pose : some_poses(tree, distance))
            touching += walk_pair(tree, Kind::oriented_box, pose, 0, 0, ignored) ? 1u : 0u;
        if (20 * touching >= 9 * pose_count && 20 * touching <= 13 * pose_count) return some_poses(tree, distance);
        (2 * touching > pose_count ? near : far) = distance;
    }
    return some_poses(tree, 0.5 * (near + far));
}

void measure(const Mesh& mesh) {
    const Tree tree = make_tree(mesh);
    const std::vector<Pose> poses = balanced_poses(tree);
    std::array<double, 4> areas{};
    std::array<double, 4> spaces{};
    for (const TreeNode& node : tree.nodes) {
        for (std::size_t k = 0; k < 4; ++k) {
            areas[k] += node.volumes.areas[k];
            spaces[k] += node.volumes.spaces[k];
        }
    }
    constexpr auto aligned = static_cast<std::size_t>(Kind::aligned_box);
    const Point side = tree.high - tree.low;
    const double radius = 0.02 * std::sqrt(dot(side, side));
    std::array<std::uint64_t, 3> expected{};
    for (const Kind kind : all_kinds) {
        const auto k = static_cast<std::size_t>(kind);
        Counts rays;
        Counts balls;
        Counts pairs;
        tests::Random random(seed);
        for (std::size_t i = 0; i < query_count; ++i) {
            const Point from = point_in(tree, random, 1.0);
            const Line line = {from, point_in(tree, random, 0.0) - from};
            double nearest = std::numeric_limits<double>::infinity();
            walk_ray(tree, kind, line, 0, nearest, rays);
            rays.answers += nearest < std::numeric_limits<double>::infinity() ? 1u : 0u;
        }
        for (std::size_t i = 0; i < query_count; ++i)
            walk_ball(tree, kind, {point_in(tree, random, 0.0), radius}, 0, balls);
        for (const Pose& pose : poses) pairs.answers += walk_pair(tree, kind, pose, 0, 0, pairs) ? 1u : 0u;
        const std::array<std::uint64_t, 3> answers = {rays.answers, balls.answers, pairs.answers};
        if (kind == all_kinds[0]) expected = answers;
        if (answers != expected)
            std::fprintf(stderr, "%s: the %s tree answers otherwise\n", mesh.name.c_str(), kind_names[k]);
        const auto per = [](std::uint64_t count, std::size_t queries) {
            return static_cast<double>(count) / static_cast<double>(queries);
        };
        std::printf("| %s | %s | %d | %.2f | %.2f | %.1f, %.1f | %.1f, %.1f | %.0f, %.0f |\n", mesh.name.c_str(),
                    kind_names[k], numbers_stored[k], areas[k] / areas[aligned], spaces[k] / spaces[aligned],
                    per(rays.volumes, query_count), per(rays.triangles, query_count), per(balls.volumes, query_count),
                    per(balls.triangles, query_count), per(pairs.volumes, pose_count),
                    per(pairs.triangles, pose_count));
        std::fflush(stdout);
    }
    std::fprintf(stderr, "%s: %zu triangles, %zu nodes; of %zu rays %llu hit, of %zu poses %llu touch\n",
                 mesh.name.c_str(), tree.triangles.size(), tree.nodes.size(), query_count,
                 static_cast<unsigned long long>(expected[0]), pose_count,
                 static_cast<unsigned long long>(expected[2]));
}

}  // namespace

int main(int count, char** words) {
    Program program("espalier_bench_volumes", "Which bounding volume? Tests that queries make, in Markdown");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        std::printf(
            "| mesh | volume | numbers | area | space | ray: volumes, triangles | sphere | mesh and mesh |\n"
            "|---|---|---|---|---|---|---|---|\n");
        for (const std::string& file : meshes) measure(tests::read_mesh(file));
    });
}
