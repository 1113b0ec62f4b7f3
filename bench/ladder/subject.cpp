#include "subject.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <espalier/bake.hpp>

#include <baker/bake_with.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "../../tests/support/base/random.hpp"

namespace espalier::bench {
namespace {

/// The share of the largest coordinate by which a box is larger than its triangles.
constexpr float margin_share = 0x1p-19f;

BakeOptions options_for(Profile profile) {
    BakeOptions options;
    options.profile = profile;
    options.threads = 1;
    return options;
}

BakedBlob opened(const std::string& mesh, BakeResult baked) {
    if (!baked) throw std::runtime_error(mesh + ": " + baked.message);
    BakedBlob made{std::move(baked.bytes), {}};
    made.blob = open(made.bytes);
    if (!made.blob) throw std::runtime_error(mesh + ": the blob does not open: " + describe(made.blob.status()));
    return made;
}

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

float largest_coordinate(const Mesh& mesh) {
    float largest = 0.0f;
    for (const Vec3& p : mesh.positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest;
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
    made.fast = opened(mesh.name, baker::bake_with(build_and_keep, {&view, 1}, options_for(Profile::fast)));
    made.balanced = opened(mesh.name, bake({&view, 1}, options_for(Profile::balanced)));
    made.small_blob = opened(mesh.name, bake({&view, 1}, options_for(Profile::small)));
    if (made.mesh.triangles.size() <= Link::most_triangles || made.mesh.triangles.size() > Link::most_first)
        throw std::runtime_error(mesh.name + ": too few triangles for a tree, or too many");
    made.margin = margin_share * largest_coordinate(made.mesh);
    return made;
}

std::vector<Aabb> boxes_on_surface(const LadderSubject& subject, std::size_t count, std::uint64_t seed) {
    const Mesh& mesh = subject.mesh;
    Aabb around = Aabb::none();
    for (const TriangleVertices& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) around.add(mesh.positions[vertex]);
    double side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) side = std::max(side, double(around.high[k]) - double(around.low[k]));
    const auto half = static_cast<float>(subject.step * std::max(1.0, std::floor(side / subject.step / 128.0)));
    tests::Random random(seed);
    std::vector<Aabb> boxes;
    while (boxes.size() < count) {
        const TriangleVertices& triangle = mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))];
        const Vec3& p = mesh.positions[triangle[random.below(3)]];
        boxes.push_back({{p.x - half, p.y - half, p.z - half}, {p.x + half, p.y + half, p.z + half}});
    }
    return boxes;
}

}  // namespace espalier::bench
