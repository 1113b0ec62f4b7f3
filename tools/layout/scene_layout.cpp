#include "scene_layout.hpp"

#include <espalier/format.hpp>

#include "blob_layout.hpp"

namespace espalier::tools {

namespace {

std::size_t sum_of(std::span<const ScenePart> parts) {
    std::size_t sum = 0;
    for (const ScenePart& part : parts) sum += part.bytes;
    return sum;
}

}  // namespace

std::size_t SceneLayout::mesh_bytes() const { return sum_of(std::span(parts).first(mesh_count)); }
std::size_t SceneLayout::tile_bytes() const { return sum_of(std::span(parts).subspan(mesh_count)); }

SceneLayout layout_of(std::span<const std::byte> bytes, const BakedScene& scene) {
    using namespace format::scene;
    SceneLayout layout{};
    layout.mesh_count = scene.meshes().size();
    const std::size_t count = layout.mesh_count + scene.tiles().size();
    layout.part_sizes = {header_bytes, count * part_size_bytes};
    std::size_t at = layout.part_sizes.at + layout.part_sizes.bytes;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = aligned(at);
        layout.parts.push_back({begin, read_u32(bytes, header_bytes + i * part_size_bytes)});
        layout.padding += begin - at;
        at = begin + layout.parts.back().bytes;
    }
    layout.nodes = {aligned(at), detail::data_of(scene).tree.node_count * format::packed_node::bytes};
    layout.padding += layout.nodes.at - at;
    layout.instances = {layout.nodes.at + layout.nodes.bytes, scene.instance_count() * instance_bytes};
    return layout;
}

}  // namespace espalier::tools
