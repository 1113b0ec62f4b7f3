#include <baker/encode/encode.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

#include <espalier/format.hpp>
#include <runtime/blob/checksum.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/encode/ids.hpp>
#include <baker/encode/motion.hpp>
#include <baker/encode/tree.hpp>

namespace espalier::baker {

namespace {

std::uint32_t features_of(const Source& source, const BakeOptions& options, const Properties& properties,
                          const WideTree& wide, const OptionalSections& sections) {
    std::uint32_t features = sections.features;
    if (options.original_ids) features |= format::feature::original_ids | format::feature::id_runs;
    if (source.material_bits == 8) features |= format::feature::materials_8;
    if (source.material_bits == 16) features |= format::feature::materials_16;
    if (properties.closed) features |= format::feature::closed;
    if (wide.copies != 0) features |= format::feature::split_references;
    if (options.deformation) features |= format::feature::deformable;
    if (source.origin != Vec3d{}) features |= format::feature::source_origin;
    return features;
}

std::uint16_t version_minor_of(std::uint32_t features) {
    std::uint16_t least = 0;
    const auto need = [&](std::uint32_t feature, std::uint16_t minor) {
        if ((features & feature) != 0) least = std::max(least, minor);
    };
    need(format::feature::deformable, format::version_minor_of_deformable);
    need(format::feature::id_runs, format::version_minor_of_id_runs);
    need(format::feature::source_origin, format::version_minor_of_source_origin);
    return least;
}

std::uint32_t original_id(const LatticeMesh& mesh, const WideTree& wide, std::size_t storage_index) {
    return mesh.triangles[wide.triangles[storage_index]].original_id;
}

void put_source_table(std::vector<std::byte>& blob, const Source& source) {
    for (std::size_t i = 0; i < source.meshes.size(); ++i) {
        put_u32(blob, source.first_triangle[i]);
        put_u32(blob, source.meshes[i].file);
        put_u32(blob, source.meshes[i].mesh);
    }
}

std::vector<std::uint32_t> numbers_of(const LatticeMesh& mesh, const WideTree& wide, Profile profile) {
    std::vector<std::uint32_t> numbers(wide.triangles.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = format::ids::corner_factor(profile) * original_id(mesh, wide, i) + wide.first_corners[i];
    return numbers;
}

void put_materials(std::vector<std::byte>& blob, const Source& source, const LatticeMesh& mesh, const WideTree& wide) {
    for (std::size_t i = 0; i < wide.triangles.size(); ++i) {
        const std::uint32_t material = material_of(source, original_id(mesh, wide, i));
        if (source.material_bits == 8) {
            put_u8(blob, material);
        } else {
            put_u16(blob, material);
        }
    }
    pad_to(blob, 4);
}

void put_copies(std::vector<std::byte>& blob, const LatticeMesh& mesh, const WideTree& wide) {
    using namespace format::copies;
    constexpr std::uint32_t none = 0xFFFFFFFFu;
    std::vector<std::uint32_t> owners(mesh.triangles.size(), none);
    std::vector<std::uint32_t> owners_of_copies;
    put_u32(blob, wide.copies);
    for (std::size_t first = 0; first < wide.triangles.size(); first += block_indices) {
        put_u32(blob, static_cast<std::uint32_t>(owners_of_copies.size()));
        BitStream bits(blob);
        for (std::size_t i = first; i < first + block_indices; ++i) {
            bool is_copy = false;
            if (i < wide.triangles.size()) {
                std::uint32_t& owner = owners[wide.triangles[i]];
                is_copy = owner != none;
                if (is_copy) owners_of_copies.push_back(owner);
                else owner = static_cast<std::uint32_t>(i);
            }
            bits.put(is_copy ? 1 : 0, 1);
        }
        bits.finish();
    }
    for (const std::uint32_t owner : owners_of_copies) put_u32(blob, owner);
}

void put_source_origin(std::vector<std::byte>& blob, const Vec3d& origin) {
    blob.resize(blob.size() + format::source_origin::bytes);
    set_vec3d(blob.data() + blob.size() - format::source_origin::bytes, origin);
}

void put_header(std::byte* header, const Source& source, const LatticeMesh& mesh, const WideTree& wide,
                const BakeOptions& options, const Properties& properties, const OptionalSections& sections) {
    using namespace format::header;
    const std::uint32_t features = features_of(source, options, properties, wide, sections);
    set_u32(header + magic_at, format::magic);
    set_u16(header + version_major_at, format::version_major);
    set_u16(header + version_minor_at, version_minor_of(features));
    set_u32(header + features_at, features);
    set_u8(header + profile_at, static_cast<std::uint32_t>(options.profile));
    set_u8(header + bits_at, mesh.lattice.bits);
    set_u16(header + step_exponent_at, static_cast<std::uint32_t>(mesh.lattice.step_exponent) & 0xFFFF);
    set_u32(header + triangle_count_at, static_cast<std::uint32_t>(wide.triangles.size()));
    set_u32(header + vertex_count_at, mesh.used_vertices);
    set_u32(header + node_count_at, static_cast<std::uint32_t>(wide.nodes.size()));
    set_u32(header + origin_at, std::bit_cast<std::uint32_t>(mesh.lattice.origin.x));
    set_u32(header + origin_at + 4, std::bit_cast<std::uint32_t>(mesh.lattice.origin.y));
    set_u32(header + origin_at + 8, std::bit_cast<std::uint32_t>(mesh.lattice.origin.z));
    set_u32(header + extent_at, static_cast<std::uint32_t>(mesh.extent.x));
    set_u32(header + extent_at + 4, static_cast<std::uint32_t>(mesh.extent.y));
    set_u32(header + extent_at + 8, static_cast<std::uint32_t>(mesh.extent.z));
    set_u32(header + max_error_at, std::bit_cast<std::uint32_t>(properties.max_error));
    set_u8(header + depth_at, wide.depth);
    if (options.original_ids) {
        set_u32(header + source_count_at, static_cast<std::uint32_t>(source.meshes.size()));
    }
    set_u32(header + source_triangles_at, source.triangle_count);
}

std::optional<Refusal> check_limits(const WideTree& wide, std::uint64_t total_bytes) {
    constexpr const char* advice = "; split the input into several blobs";
    if (wide.nodes.size() > format::max_nodes) {
        return Refusal{BakeStatus::too_large, "the tree has " + std::to_string(wide.nodes.size()) +
                                                  " nodes; a blob holds at most " + std::to_string(format::max_nodes) +
                                                  advice};
    }
    if (wide.triangles.size() > format::max_triangles) {
        return Refusal{BakeStatus::too_large, "with copies there are " + std::to_string(wide.triangles.size()) +
                                                  " triangles; a blob holds at most " +
                                                  std::to_string(format::max_triangles) + advice};
    }
    if (total_bytes > std::numeric_limits<std::uint32_t>::max()) {
        return Refusal{BakeStatus::too_large, "the blob would have " + std::to_string(total_bytes) +
                                                  " bytes; it can have at most 4294967295" + advice};
    }
    return std::nullopt;
}

std::optional<Refusal> check_number_limit(std::uint64_t limit) {
    if (limit >> 32 == 0) return std::nullopt;
    return Refusal{BakeStatus::too_large,
                   "with original ids the sources can have at most 1431655765 triangles (4294967295 in profile fast), "
                   "dropped ones included; split the input into several blobs"};
}

}  // namespace

Expected<std::vector<std::byte>> encode(const Source& source, const LatticeMesh& mesh, const BinaryTree& tree,
                                        const WideTree& wide, const BakeOptions& options, const Properties& properties,
                                        const OptionalSections& sections) {
    if (auto refusal = check_limits(wide, 0)) return *refusal;
    const EncodedTree encoded = encode_tree(mesh, tree, wide, options.profile);

    std::vector<std::byte> blob(format::header::bytes);
    blob.reserve(format::header::bytes + encoded.nodes.size() + encoded.leaves.size() + format::guard_bytes);
    blob.insert(blob.end(), encoded.nodes.begin(), encoded.nodes.end());
    blob.insert(blob.end(), encoded.leaves.begin(), encoded.leaves.end());
    blob.resize(blob.size() + format::guard_bytes);
    IdSteps id_steps;
    if (options.original_ids) {
        const std::uint64_t limit = format::ids::number_limit(options.profile, source.triangle_count);
        if (auto refusal = check_number_limit(limit)) return *refusal;
        put_source_table(blob, source);
        id_steps = put_ids(blob, numbers_of(mesh, wide, options.profile), format::ids::number_bits(limit));
    }
    if (source.material_bits != 0) put_materials(blob, source, mesh, wide);
    if (wide.copies != 0) put_copies(blob, mesh, wide);
    put_optional_sections(blob, sections, wide);
    const std::uint32_t vertex_slots = options.deformation ? put_corners_and_sources(blob, mesh, wide) : 0;
    if (source.origin != Vec3d{}) put_source_origin(blob, source.origin);
    if (auto refusal = check_limits(wide, blob.size())) return *refusal;

    put_header(blob.data(), source, mesh, wide, options, properties, sections);
    set_u8(blob.data() + format::header::id_kind_bits_at, id_steps.kind_bits);
    set_u32(blob.data() + format::header::id_step_bytes_at, id_steps.bytes);
    set_u32(blob.data() + format::header::leaf_bytes_at, static_cast<std::uint32_t>(encoded.leaves.size()));
    set_u32(blob.data() + format::header::total_bytes_at, static_cast<std::uint32_t>(blob.size()));
    if (options.deformation) put_motion(blob.data(), mesh, vertex_slots, encoded);
    set_u32(blob.data() + format::header::checksum_at, detail::checksum_of_blob(blob));
    return blob;
}

}  // namespace espalier::baker
