// Joins blobs and instances in a scene.
#include <espalier/bake.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include <espalier/format.hpp>
#include <espalier/scene.hpp>
#include <runtime/blob/checksum.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/base/expected.hpp>
#include <baker/scenes/common_lattice.hpp>
#include <baker/scenes/instance_boxes.hpp>
#include <baker/scenes/instance_tree.hpp>
#include <baker/scenes/part.hpp>

namespace espalier {

namespace baker {

namespace {

using Bytes = std::span<const std::byte>;

/// The distinct blobs and tiles that instances use: meshes first, each kind in order of first use.
struct Parts {
    std::vector<ScenePart> parts;
    std::uint32_t mesh_count = 0;
    std::vector<std::uint32_t> number_of_given;  ///< of each blob or tile that was given
};

constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();

bool is_valid(const Transform& transform) {
    const Vec3 moved = to_local(transform, transform.translation);
    return std::isfinite(moved.x) && std::isfinite(moved.y) && std::isfinite(moved.z);
}

/// The numbers of parts, by the checksum of their bytes.
using NumbersByChecksum = std::multimap<std::uint32_t, std::uint32_t>;

/// Returns the number of the part with the same bytes, a new one if none has them.
std::uint32_t find_or_add(std::vector<ScenePart>& parts, NumbersByChecksum& numbers, ScenePart part) {
    const auto [begin, end] = numbers.equal_range(part.tree().checksum);
    for (auto at = begin; at != end; ++at)
        if (std::ranges::equal(parts[at->second].bytes(), part.bytes())) return at->second;
    const auto number = static_cast<std::uint32_t>(parts.size());
    numbers.emplace(part.tree().checksum, number);
    parts.push_back(std::move(part));
    return number;
}

/// Numbers the meshes before the tiles.
void put_meshes_first(Parts& found) {
    std::vector<ScenePart> sorted;
    std::vector<std::uint32_t> number(found.parts.size());
    for (const bool is_tile : {false, true}) {
        for (std::size_t i = 0; i < found.parts.size(); ++i) {
            if (found.parts[i].is_tile() != is_tile) continue;
            number[i] = static_cast<std::uint32_t>(sorted.size());
            sorted.push_back(std::move(found.parts[i]));
        }
        if (!is_tile) found.mesh_count = static_cast<std::uint32_t>(sorted.size());
    }
    found.parts = std::move(sorted);
    for (std::uint32_t& given : found.number_of_given)
        if (given != unused) given = number[given];
}

Expected<Parts> find_parts(std::span<const Bytes> blobs, std::span<const Instance> instances) {
    Parts found;
    NumbersByChecksum numbers;
    found.number_of_given.assign(blobs.size(), unused);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::string name = "instance " + std::to_string(i);
        const Instance& instance = instances[i];
        if (instance.mesh >= blobs.size())
            return Refusal{BakeStatus::invalid_mesh, name + " is of mesh " + std::to_string(instance.mesh) + ", but " +
                                                         std::to_string(blobs.size()) +
                                                         " meshes were given; count meshes from 0"};
        if (!is_valid(instance.transform))
            return Refusal{BakeStatus::invalid_mesh,
                           name +
                               " has a transform that cannot be applied: all numbers must be finite, the rotation "
                               "must have a length, and the scale must be between 2^-100 and 2^100"};
        std::uint32_t& number = found.number_of_given[instance.mesh];
        if (number != unused) continue;
        Expected<ScenePart> part = ScenePart::open(blobs[instance.mesh]);
        if (!part)
            return Refusal{BakeStatus::invalid_mesh,
                           "mesh " + std::to_string(instance.mesh) + " of " + name + ": " + part.refusal().message};
        number = find_or_add(found.parts, numbers, std::move(*part));
    }
    put_meshes_first(found);
    return found;
}

void put_instance(std::vector<std::byte>& bytes, const Instance& instance, std::uint32_t mesh, std::uint32_t source) {
    const Transform& t = instance.transform;
    for (const float number : {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w, t.translation.x, t.translation.y,
                               t.translation.z, t.scale})
        put_f32(bytes, number);
    for (const std::uint32_t number : {mesh, instance.mask, instance.user, source}) put_u32(bytes, number);
}

void put_common_lattice(std::byte* header, const espalier::Lattice& region) {
    using namespace format::scene;
    set_u32(header + features_at, has_common_lattice);
    set_u16(header + common_step_exponent_at, static_cast<std::uint32_t>(region.step_exponent) & 0xFFFF);
    const float origin[3] = {region.origin.x, region.origin.y, region.origin.z};
    for (std::size_t k = 0; k < 3; ++k) {
        set_u32(header + common_origin_at + 4 * k, std::bit_cast<std::uint32_t>(origin[k]));
        set_u32(header + common_extent_at + 4 * k, static_cast<std::uint32_t>(region.extent[k]));
    }
}

void put_header(std::byte* header, const SceneReport& report, const BoxLattice& lattice) {
    using namespace format::scene;
    set_u32(header + magic_at, magic);
    set_u16(header + version_major_at, version_major);
    set_u16(header + version_minor_at, version_minor);
    set_u32(header + total_bytes_at, static_cast<std::uint32_t>(report.bytes));
    set_u8(header + depth_at, report.depth);
    set_u16(header + step_exponent_at, static_cast<std::uint32_t>(lattice.step_exponent) & 0xFFFF);
    set_u32(header + mesh_count_at, report.meshes);
    set_u32(header + tile_count_at, report.tiles);
    set_u32(header + tile_mesh_count_at, report.meshes_in_tiles);
    set_u32(header + instance_count_at, report.instances);
    set_u32(header + node_count_at, report.nodes);
    const float origin[3] = {lattice.origin.x, lattice.origin.y, lattice.origin.z};
    for (std::size_t k = 0; k < 3; ++k) {
        set_u32(header + origin_at + 4 * k, std::bit_cast<std::uint32_t>(origin[k]));
        set_u32(header + extent_at + 4 * k, static_cast<std::uint32_t>(lattice.extent[k]));
    }
    set_u32(header + max_error_at, std::bit_cast<std::uint32_t>(report.max_error));
}

Refusal too_large(const std::string& what) { return {BakeStatus::too_large, what + "; split the scene into several"}; }

Expected<SceneBakeResult> join(std::span<const Bytes> blobs, std::span<const Instance> instances) {
    if (instances.size() > format::scene::max_instances)
        return too_large("there are " + std::to_string(instances.size()) + " instances; a scene holds at most " +
                         std::to_string(format::scene::max_instances));
    const Expected<Parts> found = find_parts(blobs, instances);
    if (!found) return found.refusal();
    const std::vector<ScenePart>& parts = found->parts;

    SceneBakeResult result;
    SceneReport& report = result.report;
    std::vector<PartBoxes> boxes_of_parts(parts.begin(), parts.end());
    std::vector<std::uint64_t> triangles_of_parts;
    triangles_of_parts.reserve(parts.size());
    for (const ScenePart& part : parts) triangles_of_parts.push_back(part.triangle_count());
    std::vector<WorldBox> boxes;
    std::vector<WorldBox> lattices;
    std::vector<std::optional<espalier::Lattice>> lattice_of_instance;
    for (const Instance& instance : instances) {
        const std::uint32_t number = found->number_of_given[instance.mesh];
        const ScenePart& part = parts[number];
        boxes.push_back(boxes_of_parts[number].at(instance.transform));
        lattices.push_back(boxes_of_parts[number].lattice_at(instance.transform));
        lattice_of_instance.push_back(part.lattice());
        report.triangles += triangles_of_parts[number];
        report.max_error = std::max(report.max_error, part.error_at(instance.transform));
    }
    BoxLattice lattice;
    if (!fit_boxes(boxes, lattices, lattice) || !std::isfinite(report.max_error))
        return too_large("the instances lie too far apart for float32, or it cannot hold their error");
    const InstanceTree tree = build_instance_tree(lattice.boxes);

    std::vector<std::byte> bytes(format::scene::header_bytes);
    for (const ScenePart& part : parts) put_u32(bytes, static_cast<std::uint32_t>(part.bytes().size()));
    for (const ScenePart& part : parts) {
        pad_to(bytes, format::scene::alignment);
        bytes.insert(bytes.end(), part.bytes().begin(), part.bytes().end());
        (part.is_tile() ? report.tile_bytes : report.mesh_bytes) += part.bytes().size();
        report.meshes_in_tiles += part.meshes_in_tile();
    }
    pad_to(bytes, format::scene::alignment);
    bytes.insert(bytes.end(), tree.nodes.begin(), tree.nodes.end());
    for (const std::uint32_t i : tree.order)
        put_instance(bytes, instances[i], found->number_of_given[instances[i].mesh], i);
    report.meshes = found->mesh_count;
    report.tiles = static_cast<std::uint32_t>(parts.size()) - found->mesh_count;
    report.instances = static_cast<std::uint32_t>(instances.size());
    report.nodes = static_cast<std::uint32_t>(tree.nodes.size() / format::packed_node::bytes);
    report.depth = tree.depth;
    report.bytes = bytes.size();
    if (report.bytes > std::numeric_limits<std::uint32_t>::max() || report.nodes > format::max_nodes)
        return too_large("the scene would have " + std::to_string(report.bytes) +
                         " bytes; it can have at most 4294967295");
    put_header(bytes.data(), report, lattice);
    if (const auto common = find_common_lattice(instances, lattice_of_instance)) {
        put_common_lattice(bytes.data(), common->region);
        report.on_common_lattice = common->instances;
    }
    set_u32(bytes.data() + format::scene::checksum_at, detail::checksum_of_blob(bytes));
    result.bytes = std::move(bytes);
    result.status = BakeStatus::ok;
    return result;
}

}  // namespace

}  // namespace baker

SceneBakeResult bake_scene(std::span<const std::span<const std::byte>> blobs, std::span<const Instance> instances) {
    baker::Expected<SceneBakeResult> result = baker::join(blobs, instances);
    if (result) return std::move(*result);
    SceneBakeResult refused;
    refused.status = result.refusal().status;
    refused.message = result.refusal().message;
    return refused;
}

}  // namespace espalier
