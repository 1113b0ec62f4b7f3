#include <import/gltf/nodes.hpp>

#include <array>
#include <cmath>
#include <limits>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

constexpr std::size_t no_parent = std::numeric_limits<std::size_t>::max();

constexpr double largest_rounding = 1e-6;  // some steps of float32 at 1

/// Returns the transform of a translation, then a rotation as x, y, z, w of any length but zero, then a scale.
Placement placement_from(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                         const std::array<double, 3>& scale, const GltfObject& described) {
    auto [x, y, z, w] = rotation;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(length > 0.0) || !std::isfinite(length))
        described.fail("a rotation of it is none: its length is 0 or infinite");
    x /= length, y /= length, z /= length, w /= length;
    Placement result;
    result.linear = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                      {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                      {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
    for (auto& row : result.linear) {
        for (std::size_t column = 0; column < 3; ++column) row[column] *= scale[column];
    }
    result.offset = translation;
    return result;
}

/// Returns the transform of a 4x4 matrix by columns. Throws ImportError, with the words `matrix`, when its last row is
/// not 0 0 0 1.
Placement placement_of_matrix(const std::array<double, 16>& columns, const GltfObject& described,
                              std::string_view matrix) {
    const auto& m = columns;
    // Exporters that multiply matrices round the last entry; its digits are no part of the transform.
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || !(std::abs(m[15] - 1.0) <= largest_rounding)) {
        described.fail(text("the last row of ", matrix, " is not 0 0 0 1"));
    }
    Placement result;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) result.linear[row][column] = m[column * 4 + row];
        result.offset[row] = m[12 + row];
    }
    return result;
}

Placement local_placement(const GltfObject& node) {
    if (const auto columns = node.numbers<16>("matrix")) {
        for (const char* key : {"translation", "rotation", "scale"}) {
            if (node.has(key)) node.fail(text("it has a matrix and a ", key, ", and glTF allows only one of them"));
        }
        return placement_of_matrix(*columns, node, "its matrix");
    }
    return placement_from(node.numbers<3>("translation").value_or(std::array<double, 3>{}),
                          node.numbers<4>("rotation").value_or(std::array<double, 4>{0, 0, 0, 1}),
                          node.numbers<3>("scale").value_or(std::array<double, 3>{1, 1, 1}), node);
}

/// Returns each node's parent, or no_parent. A node has at most one.
std::vector<std::size_t> parents_of(const GltfObject& root, std::size_t count) {
    std::vector<std::size_t> parents(count, no_parent);
    for (std::size_t parent = 0; parent < count; ++parent) {
        const GltfObject node = gltf_node(root, parent);
        for (std::size_t i = 0; i < node.size_of("children"); ++i) {
            const std::size_t child = node.index_in("children", i, count);
            if (parents[child] != no_parent) {
                gltf_node(root, child).fail(text("it is a child of node ", parents[child], " and of node ", parent));
            }
            parents[child] = parent;
        }
    }
    return parents;
}

/// Calls `visit` with a node and its children, and theirs, each before its children. Keeps an own stack: how deep a
/// file nests is not ours to choose.
template <class Visit>
void visit_below(const GltfObject& root, std::size_t top, std::size_t count, const Visit& visit) {
    std::vector<std::size_t> waiting{top};
    while (!waiting.empty()) {
        const std::size_t number = waiting.back();
        waiting.pop_back();
        visit(number);
        const GltfObject node = gltf_node(root, number);
        for (std::size_t i = node.size_of("children"); i-- > 0;) {
            waiting.push_back(node.index_in("children", i, count));
        }
    }
}

std::vector<std::size_t> tops_of_scene(const GltfObject& root, const std::vector<std::size_t>& parents) {
    std::vector<std::size_t> tops;
    const std::size_t scenes = root.size_of("scenes");
    if (scenes == 0) {
        for (std::size_t i = 0; i < parents.size(); ++i) {
            if (parents[i] == no_parent) tops.push_back(i);
        }
        return tops;
    }
    const std::size_t number = root.index("scene", scenes).value_or(0);
    const GltfObject scene = root.object_in("scenes", number, text(root.words(), ", scene ", number));
    for (std::size_t i = 0; i < scene.size_of("nodes"); ++i) {
        const std::size_t top = scene.index_in("nodes", i, parents.size());
        if (parents[top] != no_parent) {
            scene.fail(text("node ", top, " is at its top, and also a child of node ", parents[top]));
        }
        tops.push_back(top);
    }
    return tops;
}

/// An attribute of all instances, or the same value for each.
template <std::size_t Count>
class InstanceAttribute {
public:
    InstanceAttribute(const GltfObject& attributes, const char* name, GltfUse use, GltfData& data,
                      const std::array<double, Count>& otherwise)
        : otherwise_(otherwise) {
        const auto number = attributes.index(name, data.accessor_count());
        if (number) accessor_ = data.accessor(*number, use, text(attributes.words(), ", ", name));
        if (accessor_) require_stored(*accessor_, attributes);
    }

    [[nodiscard]] std::optional<std::size_t> count() const {
        return accessor_ ? std::optional(accessor_->count) : std::nullopt;
    }
    [[nodiscard]] std::array<double, Count> operator[](std::size_t instance) const {
        if (!accessor_) return otherwise_;
        std::array<double, Count> result{};
        for (std::size_t i = 0; i < Count; ++i) result[i] = accessor_->number(instance, i);
        return result;
    }

private:
    std::optional<GltfAccessor> accessor_;
    std::array<double, Count> otherwise_;
};

Placement inverse_bind_placement(const GltfAccessor& matrices, std::size_t joint, const GltfObject& skin) {
    std::array<double, 16> columns{};
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = matrices.number(joint, i);
    return placement_of_matrix(columns, skin, text("inverse bind matrix ", joint));
}

void add_weighted(Placement& sum, const Placement& part, double weight) {
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            sum.linear[row][column] += weight * part.linear[row][column];
        }
        sum.offset[row] += weight * part.offset[row];
    }
}

}  // namespace

Placement gltf_centre(const GltfObject& root) {
    Placement result;
    const auto relative = root.extension("CESIUM_RTC");
    if (!relative) return result;
    result.offset = relative->numbers<3>("center").value_or(std::array<double, 3>{});
    return result;
}

GltfObject gltf_node(const GltfObject& root, std::size_t number) {
    return root.object_in("nodes", number, text(root.words(), ", node ", number));
}

GltfNodes read_gltf_nodes(const GltfObject& root) {
    const std::size_t count = root.size_of("nodes");
    const std::vector<std::size_t> parents = parents_of(root, count);
    GltfNodes nodes;
    nodes.global.resize(count);
    nodes.path.resize(count);
    std::vector<bool> is_placed(count, false);
    for (std::size_t top = 0; top < count; ++top) {
        if (parents[top] != no_parent) continue;
        visit_below(root, top, count, [&](std::size_t number) {
            const GltfObject node = gltf_node(root, number);
            const Placement local = local_placement(node);
            const std::size_t parent = parents[number];
            nodes.path[number] =
                nodes.paths.add(parent == no_parent ? NodePaths::no_node : nodes.path[parent], node.text_of("name"));
            nodes.global[number] = parent == no_parent ? local : combine(nodes.global[parent], local);
            is_placed[number] = true;
        });
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_placed[i]) gltf_node(root, i).fail("it is below itself: its children form a circle");
    }
    std::vector<bool> is_in_scene(count, false);
    for (const std::size_t top : tops_of_scene(root, parents)) {
        if (is_in_scene[top]) continue;
        visit_below(root, top, count, [&](std::size_t number) {
            is_in_scene[number] = true;
            nodes.in_scene.push_back(number);
        });
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_in_scene[i] && gltf_node(root, i).has("mesh")) nodes.left_out.push_back(i);
    }
    return nodes;
}

std::vector<Placement> gltf_instances(const GltfObject& node, GltfData& data) {
    const auto extension = node.extension("EXT_mesh_gpu_instancing");
    if (!extension) return {Placement{}};
    const auto attributes = extension->object("attributes");
    if (!attributes) extension->fail("\"attributes\" is missing");
    const InstanceAttribute<3> translation(*attributes, "TRANSLATION", GltfUse::translation, data, {});
    const InstanceAttribute<4> rotation(*attributes, "ROTATION", GltfUse::rotation, data, {0, 0, 0, 1});
    const InstanceAttribute<3> scale(*attributes, "SCALE", GltfUse::scale, data, {1, 1, 1});
    std::optional<std::size_t> count;
    for (const auto each : {translation.count(), rotation.count(), scale.count()}) {
        if (each && count && *each != *count) attributes->fail("its attributes have different numbers of instances");
        if (each) count = each;
    }
    if (!count) attributes->fail("it has neither TRANSLATION nor ROTATION nor SCALE");
    std::vector<Placement> result;
    result.reserve(*count);
    for (std::size_t i = 0; i < *count; ++i) {
        result.push_back(placement_from(translation[i], rotation[i], scale[i], *attributes));
    }
    return result;
}

std::uint64_t count_gltf_instances(const GltfObject& node, GltfData& data) {
    const auto extension = node.extension("EXT_mesh_gpu_instancing");
    const auto attributes = extension ? extension->object("attributes") : std::nullopt;
    if (!attributes) return 1;
    std::uint64_t count = 1;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (const auto number = attributes->index(name, data.accessor_count())) count = data.claimed_count(*number);
    }
    return count;
}

std::vector<Placement> joint_placements(GltfData& data, std::size_t skin, const GltfNodes& nodes,
                                        const Placement& asset) {
    const GltfObject object = data.root().object_in("skins", skin, text(data.root().words(), ", skin ", skin));
    const std::size_t count = object.size_of("joints");
    std::vector<Placement> result;
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back(combine(asset, nodes.global[object.index_in("joints", i, nodes.global.size())]));
    }
    const auto bind = object.index("inverseBindMatrices", data.accessor_count());
    if (!bind) return result;
    const GltfAccessor matrices = data.accessor(*bind, GltfUse::matrix, object.words());
    if (matrices.count < count)
        object.fail(text("it has ", count, " joints and ", matrices.count, " matrices for them"));
    for (std::size_t i = 0; i < count; ++i) result[i] = combine(result[i], inverse_bind_placement(matrices, i, object));
    return result;
}

Placement skinned_placement(const GltfInfluences& influences, std::size_t vertex, const std::vector<Placement>& joints,
                            const Placement& asset, const GltfObject& primitive) {
    Placement sum = scaled_by(0.0);
    double total = 0.0;
    for (const auto& [numbers, weights] : influences) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double weight = weights.number(vertex, i);
            if (weight == 0.0) continue;
            if (!(weight > 0.0) || std::isinf(weight)) {
                primitive.fail(text("a weight of vertex ", vertex, " is ", weight, ", and glTF requires 0 or more"));
            }
            const std::uint32_t joint = numbers.whole(vertex, i);
            if (joint >= joints.size()) {
                primitive.fail(text("vertex ", vertex, " depends on joint ", joint, " of ", joints.size()));
            }
            add_weighted(sum, joints[joint], weight);
            total += weight;
        }
    }
    if (!(total > 0.0)) return asset;
    if (total == 1.0) return sum;
    Placement mean = scaled_by(0.0);
    add_weighted(mean, sum, 1.0 / total);
    return mean;
}

}  // namespace espalier::importer
