// Tests whether a scene is what its header states.
#include <espalier/scenes/bake.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/format.hpp>

#include <baker/scenes/common_lattice.hpp>
#include <baker/scenes/instance_boxes.hpp>
#include <baker/scenes/part.hpp>
#include <baker/verify/decode_tree.hpp>

namespace espalier {

namespace baker {

namespace {

/// Tests that the boxes of a tree contain the instances below them, and the region their lattices.
class BoxCheck {
public:
    BoxCheck(const BakedScene& scene, const TreeBytes& tree, std::span<const ScenePart> parts)
        : scene_(scene), tree_(tree) {
        const detail::BlobData& data = detail::data_of(scene).tree;
        for (std::size_t k = 0; k < 3; ++k) {
            origin_[k] = double(data.origin[k]);
            extent_[k] = data.extent[k];
        }
        step_ = 1.0 / double(data.steps_per_unit);
        for (const ScenePart& part : parts) boxes_.emplace_back(part);
    }

    /// Returns the first instance below a node that lies outside of the box.
    std::optional<std::uint32_t> find_outside(std::uint32_t number, const DecodedBox& box) const {
        DecodedNode node;
        if (!tree_.decode_node(number, node)) return 0;
        for (unsigned child = 0; child < node.children(); ++child) {
            const DecodedBox inner = box.intersection(node.boxes[child]);
            if (child < node.node_children) {
                if (const auto found = find_outside(node.first_child + child, inner)) return found;
                continue;
            }
            const std::uint32_t id = node.leaf_block / 4 + child - node.node_children;
            if (!holds(inner, *instance_at(scene_, {id}))) return id;
        }
        return std::nullopt;
    }
    [[nodiscard]] std::optional<std::uint32_t> find_outside() const {
        DecodedBox all{};
        all.hi = extent_;
        return find_outside(0, all);
    }

private:
    [[nodiscard]] bool holds(const DecodedBox& box, const Instance& instance) const {
        DecodedBox region{};
        region.hi = extent_;
        return holds(box, boxes_[instance.mesh].at(instance.transform)) &&
               holds(region, boxes_[instance.mesh].lattice_at(instance.transform));
    }
    [[nodiscard]] bool holds(const DecodedBox& box, const WorldBox& world) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (origin_[k] + box.lo[k] * step_ > world.lo[k] || origin_[k] + box.hi[k] * step_ < world.hi[k])
                return false;
        return true;
    }

    const BakedScene& scene_;
    const TreeBytes& tree_;
    std::vector<PartBoxes> boxes_;
    std::array<double, 3> origin_{};
    Coordinates extent_{};
    double step_;
};

/// Returns a bound on how far rounding moved the place of an instance: by at most half the last bit of each coordinate.
double largest_move(const Vec3& translation) {
    double square = 0.0;
    for (const float coordinate : {translation.x, translation.y, translation.z}) {
        const double half =
            0.5 * (double(std::nextafter(std::abs(coordinate), std::numeric_limits<float>::infinity())) -
                   double(std::abs(coordinate)));
        square += half * half;
    }
    return std::sqrt(square) * (1.0 + 0x1p-50);
}

/// Returns whether the region of the common lattice is that of the instances, and no larger.
bool has_true_common_lattice(const BakedScene& scene, std::span<const ScenePart> parts) {
    std::vector<Instance> instances;
    std::vector<std::optional<espalier::Lattice>> lattices;
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        instances.push_back(*instance_at(scene, {i}));
        lattices.push_back(parts[instances.back().mesh].lattice());
    }
    const std::optional<CommonLattice> found = find_common_lattice(instances, lattices);
    const Result<espalier::Lattice> stated = scene.common_lattice();
    return found ? stated && *stated == found->region : !stated;
}

std::optional<std::string> find_fault_of_scene(std::span<const std::byte> bytes) {
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    std::vector<BakedScene> tiles(tile_count_of_scene(bytes));
    const BakedScene scene = open_scene(bytes, meshes, tiles);
    if (!scene) return describe(scene.status());
    std::vector<ScenePart> parts(scene.meshes().begin(), scene.meshes().end());
    for (const BakedScene& tile : scene.tiles()) parts.emplace_back(tile);
    const detail::SceneData& data = detail::data_of(scene);
    float error = 0.0f, error_with_moves = 0.0f;
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const Instance instance = *instance_at(scene, {i});
        const ScenePart& part = parts[instance.mesh];
        error = std::max(error, part.error_at(instance.transform, 0.0));
        const double moved = largest_move(instance.transform.translation);
        error_with_moves = std::max(error_with_moves, part.error_at(instance.transform, moved));
    }
    if (scene.max_error() < error || scene.max_error() > error_with_moves)
        return "the header (byte " + std::to_string(format::scene::max_error_at) + ") states an error of " +
               std::to_string(scene.max_error()) + ", but that of the instances is " + std::to_string(error);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string name =
            i < data.mesh_count ? "mesh " + std::to_string(i) : "tile " + std::to_string(i - data.mesh_count);
        if (const auto fault = parts[i].find_fault()) return name + ": " + *fault;
    }
    if (!has_true_common_lattice(scene, parts))
        return "the header (byte " + std::to_string(format::scene::features_at) +
               ") states another common lattice than that of the instances";
    if (scene.instance_count() == 0) return std::nullopt;
    const TreeBytes tree{{data.tree.nodes, data.tree.node_count * format::packed_node::bytes},
                         {},
                         format::scene::bits,
                         Profile::balanced,
                         false,
                         {}};
    const BoxCheck boxes(scene, tree, parts);
    if (const auto outside = boxes.find_outside())
        return "instance " + std::to_string(*outside) +
               " lies outside of a box of the tree above it, or its lattice outside of the region";
    return std::nullopt;
}

}  // namespace

}  // namespace baker

VerifyReport verify_scene(std::span<const std::byte> bytes) {
    std::optional<std::string> fault = baker::find_fault_of_scene(bytes);
    if (fault) return {false, std::move(*fault)};
    return {true, {}};
}

}  // namespace espalier
