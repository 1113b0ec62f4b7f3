#include "instances.hpp"

#include <array>
#include <optional>

#include "base/numbers.hpp"
#include "nodes.hpp"
#include "primitive.hpp"

namespace espalier::tools {

namespace {

/// An attribute of all instances, or the same value for each.
template <std::size_t Count>
class InstanceAttribute {
public:
    InstanceAttribute(const GltfObject& attributes, const char* name, GltfUse use, GltfAccessors& accessors,
                      const std::array<double, Count>& otherwise)
        : otherwise_(otherwise) {
        const auto number = attributes.index(name, accessors.count());
        if (number) accessor_ = accessors.accessor(*number, use, text(attributes.words(), ", ", name));
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

}  // namespace

std::vector<Placement> gltf_instances(const GltfObject& node, GltfAccessors& accessors) {
    const auto extension = node.extension("EXT_mesh_gpu_instancing");
    if (!extension) return {Placement{}};
    const auto attributes = extension->object("attributes");
    if (!attributes) extension->fail("\"attributes\" is missing");
    const InstanceAttribute<3> translation(*attributes, "TRANSLATION", GltfUse::translation, accessors, {});
    const InstanceAttribute<4> rotation(*attributes, "ROTATION", GltfUse::rotation, accessors, {0, 0, 0, 1});
    const InstanceAttribute<3> scale(*attributes, "SCALE", GltfUse::scale, accessors, {1, 1, 1});
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

std::uint64_t count_gltf_instances(const GltfObject& node, GltfAccessors& accessors) {
    const auto extension = node.extension("EXT_mesh_gpu_instancing");
    const auto attributes = extension ? extension->object("attributes") : std::nullopt;
    if (!attributes) return 1;
    std::uint64_t count = 1;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (const auto number = attributes->index(name, accessors.count())) count = accessors.claimed_count(*number);
    }
    return count;
}

}  // namespace espalier::tools
