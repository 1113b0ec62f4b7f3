// The proof that every query on a scene is safe, in one pass over the bytes.
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/checksum.hpp>
#include <runtime/blob/source_origin.hpp>
#include <runtime/open/checks.hpp>
#include <runtime/scenes/instances.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier {
namespace detail {
namespace {

using namespace format::scene;

constexpr FileKind scene_file = {magic, version_major, version_minor, OpenStatus::not_a_scene};
static_assert(magic_at == format::header::magic_at && total_bytes_at == format::header::total_bytes_at);

Lattice common_lattice_of(const std::byte* header) {
    Lattice lattice;
    lattice.step_exponent = load_i16(header + common_step_exponent_at);
    lattice.origin = {load_f32(header + common_origin_at), load_f32(header + common_origin_at + 4),
                      load_f32(header + common_origin_at + 8)};
    // mutant(< -> <=) sanitizer: writes behind an array
    for (std::size_t k = 0; k < 3; ++k)
        lattice.extent[k] = static_cast<std::int32_t>(load_u32(header + common_extent_at + 4 * k));
    return lattice;
}

OpenStatus read_scene_header(SceneData& scene) {
    BlobData& tree = scene.tree;
    const std::byte* const h = tree.bytes;
    const std::uint32_t features = load_u32(h + features_at);
    if ((features & ~(has_common_lattice | has_source_origin)) != 0) return OpenStatus::unsupported_feature;
    tree.profile = Profile::balanced;
    tree.bits = bits;
    scene.mesh_count = load_u32(h + mesh_count_at);
    scene.tile_count = load_u32(h + tile_count_at);
    scene.instance_count = load_u32(h + instance_count_at);
    tree.node_count = load_u32(h + node_count_at);
    const std::uint32_t depth = load_u16(h + depth_at);
    tree.depth = static_cast<std::uint8_t>(depth);
    if (scene.mesh_count > max_meshes || scene.tile_count > max_meshes || scene.instance_count > max_instances ||
        tree.node_count > format::max_nodes || depth > format::max_depth ||
        (scene.instance_count == 0) != (tree.node_count == 0) || (tree.node_count == 0) != (depth == 0))
        return OpenStatus::bad_header;
    static_assert(step_exponent_at == format::header::step_exponent_at && origin_at == format::header::origin_at &&
                  extent_at == format::header::extent_at && max_error_at == format::header::max_error_at);
    if (!read_lattice(tree)) return OpenStatus::bad_header;
    const bool has_origin = (features & has_source_origin) != 0;
    if (!is_zero(h + zeros_at, (has_origin ? source_origin_at : header_bytes) - zeros_at) ||
        (has_origin &&
         (!is_source_origin(h + source_origin_at) || load_u16(h + version_minor_at) < version_minor_of_source_origin)))
        return OpenStatus::bad_header;
    scene.has_common = (features & has_common_lattice) != 0;
    scene.common = common_lattice_of(h);
    if (scene.has_common ? !is_region(scene.common) || load_u16(h + common_step_exponent_at + 2) != 0
                         : !is_zero(h + common_origin_at, tile_mesh_count_at - common_origin_at))
        return OpenStatus::bad_header;
    tree.derive();
    return OpenStatus::ok;
}

/// The bytes that are left, from whose front parts are taken. Offsets are 64-bit numbers: no sum of them overflows.
class Parts {
public:
    explicit Parts(std::span<const std::byte> bytes) : bytes_(bytes.data()), size_(bytes.size()) {}

    /// Returns where the next part begins, or null if it does not fit in.
    const std::byte* take(std::uint64_t size) {
        if (size > size_ - at_) return nullptr;
        const std::byte* const part = bytes_ + at_;
        at_ += static_cast<std::size_t>(size);
        return part;
    }
    /// Skips the zeros before the next multiple of the alignment. Returns whether they are zeros.
    bool align() {
        const std::size_t padding = aligned(at_) - at_;
        const std::byte* const zeros = take(padding);
        return zeros != nullptr && is_zero(zeros, padding);
    }
    [[nodiscard]] bool is_at_end() const { return at_ == size_; }

private:
    const std::byte* bytes_;
    std::size_t size_;
    std::size_t at_ = header_bytes;
};

/// Takes the next mesh or tile, of the size at a place. Returns no bytes if there is none.
std::span<const std::byte> take_part(Parts& parts, const std::byte* size_at) {
    const std::uint32_t size = load_u32(size_at);
    const std::byte* const part = parts.align() ? parts.take(size) : nullptr;
    // mutant(!= -> true) equivalent: callers test the pointer
    return {part, part != nullptr ? size : 0};
}

/// Returns how many meshes all tiles have, as the header states.
std::uint32_t meshes_in_tiles(const SceneData& scene) { return load_u32(scene.tree.bytes + tile_mesh_count_at); }

/// Reads the header and opens the meshes that are not in tiles. `sizes` receives where the sizes of the tiles are.
OpenStatus open_header_and_meshes(std::span<const std::byte> bytes, SceneData& scene, Parts& parts,
                                  std::span<Blob> meshes, const std::byte*& sizes) {
    OpenStatus status = read_version_and_size(bytes.data(), bytes.size(), scene.tree, scene_file);
    if (status == OpenStatus::ok && scene.tree.checksum != checksum_of_blob(bytes)) status = OpenStatus::bad_checksum;
    if (status == OpenStatus::ok) status = read_scene_header(scene);
    if (status != OpenStatus::ok) return status;
    const std::uint64_t count = std::uint64_t{scene.mesh_count} + scene.tile_count;
    sizes = parts.take(count * part_size_bytes);
    // Each part has a header of its own, and so has each mesh of a tile.
    const std::size_t most_headers = scene.tree.size / header_bytes;
    // mutant(> -> >=) equivalent: the scene has a header, too
    if (sizes == nullptr || count > most_headers) return OpenStatus::bad_section;
    if (count + meshes_in_tiles(scene) > most_headers) return OpenStatus::bad_header;
    if (meshes.size() < scene.mesh_count) return OpenStatus::too_few_meshes;
    scene.meshes = meshes.data();
    for (Blob& mesh : meshes.first(scene.mesh_count)) {
        const std::span<const std::byte> part = take_part(parts, sizes);
        if (part.data() == nullptr) return OpenStatus::bad_section;
        mesh = open(part);
        if (!mesh) return mesh.status();
        sizes += part_size_bytes;
    }
    return OpenStatus::ok;
}

/// The instances, in the order of the nodes.
struct InstanceBlocks {
    std::uint32_t seen = 0;

    [[nodiscard]] std::uint32_t next() const { return seen; }
    /// Counts; at most 2^24 nodes with at most 8 children have less than 2^32 leaves.
    OpenStatus take(const PackedNode& node) {
        seen += node.leaf_children();
        return OpenStatus::ok;
    }
};

OpenStatus check_instances(SceneData& scene) {
    for (std::uint32_t i = 0; i < scene.instance_count; ++i) {
        const std::byte* const record = record_of(scene, {i});
        const Transform transform = transform_of(record);
        if (!is_valid(transform) || transform.scale < least_coordinate || transform.scale > greatest_scale ||
            mesh_of(record) >= scene.mesh_count + scene.tile_count)
            return OpenStatus::bad_instance;
        const auto [in_mesh, tile] = part_of(scene, record);
        const float step = in_mesh != nullptr ? scale_by_power_of_two(transform.scale, data_of(*in_mesh).step_exponent)
                                              : transform.scale * data_of(*tile).coarsest_step;
        scene.coarsest_step = maximum(step, scene.coarsest_step);
        const float scale_in_tile = tile != nullptr ? maximum(data_of(*tile).largest_scale, 1.0f) : 1.0f;
        scene.largest_scale = maximum(transform.scale * scale_in_tile, scene.largest_scale);
    }
    return OpenStatus::ok;
}

/// Checks what follows the meshes and tiles.
OpenStatus check_tree_and_instances(SceneData& scene, Parts& parts) {
    if (!parts.align()) return OpenStatus::bad_section;
    const std::uint64_t node_bytes = std::uint64_t{scene.tree.node_count} * PackedNode::size;
    scene.tree.nodes = parts.take(node_bytes + std::uint64_t{scene.instance_count} * instance_bytes);
    if (scene.tree.nodes == nullptr || !parts.is_at_end()) return OpenStatus::bad_section;
    scene.tree.leaves = scene.tree.nodes + node_bytes;
    if (scene.instance_count != 0) {
        InstanceBlocks blocks;
        const OpenStatus status = check_tree<PackedNode>(scene.tree, blocks);
        if (status != OpenStatus::ok) return status;
        if (blocks.seen != scene.instance_count) return OpenStatus::bad_node;
    }
    return check_instances(scene);
}

OpenStatus open_tile(std::span<const std::byte> bytes, SceneData& tile, std::span<Blob> meshes) {
    Parts parts(bytes);
    const std::byte* sizes = nullptr;
    const OpenStatus status = open_header_and_meshes(bytes, tile, parts, meshes, sizes);
    // The meshes are as many as the scene's header leaves for the tile.
    if (status == OpenStatus::too_few_meshes) return OpenStatus::bad_header;
    if (status != OpenStatus::ok) return status;
    if (tile.tile_count != 0 || meshes_in_tiles(tile) != 0) return OpenStatus::bad_header;
    return check_tree_and_instances(tile, parts);
}

}  // namespace
}  // namespace detail

using namespace detail;

namespace {

bool is_scene(std::span<const std::byte> bytes) {
    BlobData header;
    return read_version_and_size(bytes.data(), bytes.size(), header, scene_file) == OpenStatus::ok;
}

/// Returns a count of meshes or tiles, or 0 if the bytes are too few for it: each part has a header of its own.
std::uint32_t possible_count(std::uint64_t count, std::span<const std::byte> bytes) {
    return count <= bytes.size() / header_bytes ? static_cast<std::uint32_t>(count) : 0;
}

}  // namespace

std::uint32_t mesh_count_of_scene(std::span<const std::byte> bytes) noexcept {
    if (!is_scene(bytes)) return 0;
    const std::byte* const h = bytes.data();
    return possible_count(std::uint64_t{load_u32(h + mesh_count_at)} + load_u32(h + tile_mesh_count_at), bytes);
}

std::uint32_t tile_count_of_scene(std::span<const std::byte> bytes) noexcept {
    return is_scene(bytes) ? possible_count(load_u32(bytes.data() + tile_count_at), bytes) : 0;
}

BakedScene open_scene(std::span<const std::byte> bytes, std::span<Blob> meshes, std::span<BakedScene> tiles) noexcept {
    BakedScene scene;
    // A function of its own would have to be a friend.
    const auto open_all = [&](SceneData& data) {
        Parts parts(bytes);
        const std::byte* sizes = nullptr;
        OpenStatus status = open_header_and_meshes(bytes, data, parts, meshes, sizes);
        if (status != OpenStatus::ok) return status;
        std::span<Blob> left = meshes.subspan(data.mesh_count);
        if (tiles.size() < data.tile_count || left.size() < meshes_in_tiles(data)) return OpenStatus::too_few_meshes;
        left = left.first(meshes_in_tiles(data));
        for (BakedScene& tile : tiles.first(data.tile_count)) {
            tile = {};
            const std::span<const std::byte> part = take_part(parts, sizes);
            if (part.data() == nullptr) return OpenStatus::bad_section;
            status = open_tile(part, tile.data_, left);
            if (status != OpenStatus::ok) {
                tile = {};
                return status;
            }
            left = left.subspan(tile.data_.mesh_count);
            sizes += part_size_bytes;
        }
        data.tiles = tiles.data();
        if (!left.empty()) return OpenStatus::bad_header;
        return check_tree_and_instances(data, parts);
    };
    const OpenStatus status = open_all(scene.data_);
    if (status != OpenStatus::ok) {
        scene.data_ = {};
        scene.data_.tree.refusal = status;
    }
    return scene;
}

}  // namespace espalier
