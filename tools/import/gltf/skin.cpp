#include "skin.hpp"

#include <array>
#include <cmath>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

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

std::vector<Placement> joint_placements(const GltfObject& root, std::size_t skin, const GltfNodes& nodes,
                                        const Placement& asset, GltfAccessors& accessors) {
    const GltfObject object = root.object_in("skins", skin, text(root.words(), ", skin ", skin));
    const std::size_t count = object.size_of("joints");
    std::vector<Placement> result;
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back(combine(asset, nodes.global[object.index_in("joints", i, nodes.global.size())]));
    }
    const auto bind = object.index("inverseBindMatrices", accessors.count());
    if (!bind) return result;
    const GltfAccessor matrices = accessors.accessor(*bind, GltfUse::matrix, object.words());
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

}  // namespace espalier::tools
