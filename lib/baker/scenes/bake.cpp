// Joins blobs and instances in a scene.
#include <espalier/scenes/bake.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include <espalier/format.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/checksum.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/base/expected.hpp>
#include <baker/base/float_rounding.hpp>
#include <baker/base/number_text.hpp>
#include <baker/scenes/common_lattice.hpp>
#include <baker/scenes/instance_boxes.hpp>
#include <baker/scenes/instance_tree.hpp>
#include <baker/scenes/part.hpp>
#include <baker/scenes/placing.hpp>

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

template <class Vector>
bool is_finite(const Vector& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_valid(const Transform& transform) { return is_finite(to_local(transform, transform.translation)); }

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

Expected<Parts> find_parts(std::span<const Bytes> blobs, std::span<const Instance> instances,
                           const SceneBakeOptions& options) {
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
        Transform transform = instance.transform;
        if (!options.translations.empty()) transform.translation = {};
        if (!is_valid(transform) || (!options.translations.empty() && !is_finite(options.translations[i])))
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

void put_source_origin(std::byte* header, const Vec3d& origin) {
    using namespace format::scene;
    if (origin == Vec3d{}) return;
    set_u16(header + version_minor_at, version_minor_of_source_origin);
    set_u32(header + features_at, detail::load_u32(header + features_at) | has_source_origin);
    set_vec3d(header + source_origin_at, origin);
}

void put_header(std::byte* header, const SceneReport& report, const BoxLattice& lattice) {
    using namespace format::scene;
    set_u32(header + magic_at, magic);
    set_u16(header + version_major_at, version_major);
    set_u16(header + version_minor_at, 0);  // the lowest that suffices
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

/// The instances as the scene has them.
struct PlacedInstances {
    std::vector<Instance> instances;
    std::vector<double> moved;  ///< by rounding
};

/// Places instances in the scene; the report receives its origin and warnings.
PlacedInstances place_instances(const Parts& found, std::span<const PartBoxes> boxes_of_parts,
                                std::span<const Instance> given, const SceneBakeOptions& options, SceneReport& report) {
    std::vector<ExactPlace> places;
    std::vector<PlacedBox> boxes;
    std::vector<double> steps;
    for (const ScenePart& part : found.parts) steps.push_back(part.finest_step());
    const bool is_elsewhere = options.origin.value_or(Vec3d{}) != Vec3d{};
    for (std::size_t i = 0; i < given.size(); ++i) {
        Transform transform = given[i].transform;
        const std::uint32_t number = found.number_of_given[given[i].mesh];
        const ScenePart& part = found.parts[number];
        const Vec3d of_transform = to_float64(transform.translation);
        const Vec3d translation = options.translations.empty() ? of_transform : options.translations[i];
        const Vec3d& place = places.emplace_back(transform, translation, part.source_origin()).rounded();
        transform.translation = {};
        WorldBox box = boxes_of_parts[number].lattice_at(transform);
        const double coordinates[3] = {place.x, place.y, place.z};
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] += coordinates[k];
            box.hi[k] += coordinates[k];
        }
        boxes.push_back({box, steps[number] * double(transform.scale),
                         part.source_origin() != Vec3d{} || !fits_float32(translation) || is_elsewhere});
    }
    report.origin = options.origin ? *options.origin : choose_scene_origin(boxes);
    const auto far = find_too_far(boxes, report.origin);
    if (far) {
        const bool another_helps = !find_too_far(boxes, choose_scene_origin(boxes));
        report.warnings.push_back(
            {BakeWarning::Kind::step_below_float_spacing,
             "instance " + std::to_string(*far) + " lies where float32 is coarser than a quarter of its lattice step " +
                 short_number_text(boxes[*far].step) +
                 (another_helps ? ": choose an origin near the instances, or let the baker choose one."
                                : ": the scene is too large for this step; bake it in parts, or with a coarser one.")});
    }
    PlacedInstances placed{{given.begin(), given.end()}, std::vector<double>(given.size())};
    for (std::size_t i = 0; i < given.size(); ++i)
        if (boxes[i].is_in_float64 || report.origin != Vec3d{} || !options.translations.empty())
            placed.instances[i].transform.translation = places[i].seen_from(report.origin, placed.moved[i]);
    return placed;
}

std::optional<Refusal> find_bad_option(std::size_t instances, const SceneBakeOptions& options) {
    const std::size_t count = options.translations.size();
    if (count != 0 && count != instances)
        return Refusal{BakeStatus::invalid_options, std::to_string(count) + " translations are given for " +
                                                        std::to_string(instances) +
                                                        " instances; give one for each, or none"};
    if (options.origin && !is_finite(*options.origin))
        return Refusal{BakeStatus::invalid_options, "the origin has " + find_not_finite(*options.origin).value_or("") +
                                                        "; choose finite numbers, or none"};
    return std::nullopt;
}

Expected<SceneBakeResult> join(std::span<const Bytes> blobs, std::span<const Instance> given,
                               const SceneBakeOptions& options) {
    if (given.size() > format::scene::max_instances)
        return too_large("there are " + std::to_string(given.size()) + " instances; a scene holds at most " +
                         std::to_string(format::scene::max_instances));
    if (auto refusal = find_bad_option(given.size(), options)) return *refusal;
    const Expected<Parts> found = find_parts(blobs, given, options);
    if (!found) return found.refusal();
    const std::vector<ScenePart>& parts = found->parts;

    SceneBakeResult result;
    SceneReport& report = result.report;
    std::vector<PartBoxes> boxes_of_parts(parts.begin(), parts.end());
    const auto [instances, moved] = place_instances(*found, boxes_of_parts, given, options, report);
    std::vector<std::uint64_t> triangles_of_parts;
    triangles_of_parts.reserve(parts.size());
    for (const ScenePart& part : parts) triangles_of_parts.push_back(part.triangle_count());
    std::vector<WorldBox> boxes;
    std::vector<WorldBox> lattices;
    std::vector<std::optional<espalier::Lattice>> lattice_of_instance;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Instance& instance = instances[i];
        const std::uint32_t number = found->number_of_given[instance.mesh];
        const ScenePart& part = parts[number];
        boxes.push_back(boxes_of_parts[number].at(instance.transform));
        lattices.push_back(boxes_of_parts[number].lattice_at(instance.transform));
        lattice_of_instance.push_back(part.lattice());
        report.triangles += triangles_of_parts[number];
        report.max_error = std::max(report.max_error, part.error_at(instance.transform, moved[i]));
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
    put_source_origin(bytes.data(), report.origin);
    set_u32(bytes.data() + format::scene::checksum_at, detail::checksum_of_blob(bytes));
    result.bytes = std::move(bytes);
    result.status = BakeStatus::ok;
    return result;
}

}  // namespace

}  // namespace baker

SceneBakeResult bake_scene(std::span<const std::span<const std::byte>> blobs, std::span<const Instance> instances,
                           const SceneBakeOptions& options) {
    baker::Expected<SceneBakeResult> result = baker::join(blobs, instances, options);
    if (result) return std::move(*result);
    SceneBakeResult refused;
    refused.status = result.refusal().status;
    refused.message = result.refusal().message;
    return refused;
}

}  // namespace espalier
