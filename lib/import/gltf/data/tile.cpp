#include <import/gltf/data/tile.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <import/base/error.hpp>

namespace espalier::importer {

namespace {

constexpr std::size_t header_bytes = 28;
constexpr std::string_view tile_kinds[] = {"b3dm", "i3dm", "pnts", "cmpt"};

/// The header's numbers, after the four letters of the kind.
enum HeaderField : std::size_t { version_field, tile_bytes, feature_json, feature_binary, batch_json, batch_binary };

std::uint64_t field(std::span<const std::byte> tile, HeaderField field) {
    std::uint64_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(tile[4 + 4 * field + i]);
    return value;
}

/// Positions may be relative to a centre.
void require_no_centre(const GltfObject& table) {
    const std::optional<std::array<double, 3>> centre = table.numbers<3>("RTC_CENTER");
    if (!centre || *centre == std::array<double, 3>{}) return;
    const auto& [x, y, z] = *centre;
    table.refuse(
        text("its RTC_CENTER moves the mesh by ", x, ' ', y, ' ', z,
             ", mostly so far that float32 is too coarse there. Set it to 0 0 0 in the file, and add it to the "
             "place of the blob in your program."));
}

/// The features of the whole tile: positions may be relative to one of them.
void check_features(const std::string& path, std::string_view json) {
    if (json.empty()) return;
    const ParsedJson features = parse_json(json);
    if (features.value == nullptr) {
        throw_file_error(ImportStatus::invalid_input, path,
                         ": the JSON of its feature table is broken. Export it again.");
    }
    const GltfObject table(*features.value, text('\'', printable(path), "', feature table"));
    require_no_centre(table);
}

}  // namespace

bool is_tile(std::string_view begin) {
    return std::find(std::begin(tile_kinds), std::end(tile_kinds), begin.substr(0, 4)) != std::end(tile_kinds);
}

std::span<const std::byte> glb_of_tile(const std::string& path, std::span<const std::byte> tile) {
    const std::string_view characters(reinterpret_cast<const char*>(tile.data()), tile.size());
    if (!characters.starts_with("b3dm")) {
        throw_file_error(ImportStatus::unsupported, path, " is a tile of kind ", characters.substr(0, 4),
                         ", and of 3D Tiles 1.0 only b3dm is read. Give the glTF in it, placed as the tile places it.");
    }
    if (tile.size() < header_bytes) {
        throw_file_error(ImportStatus::invalid_input, path, " has ", tile.size(),
                         " bytes, and the header of b3dm alone has ", header_bytes, ". Copy or export it again.");
    }
    if (field(tile, version_field) != 1) {
        throw_file_error(ImportStatus::unsupported, path, " is b3dm ", field(tile, version_field), ", and 1 is read.");
    }
    const std::uint64_t tables =
        field(tile, feature_json) + field(tile, feature_binary) + field(tile, batch_json) + field(tile, batch_binary);
    const std::uint64_t stated = field(tile, tile_bytes);
    if (stated > tile.size() || stated < header_bytes || tables > stated - header_bytes) {
        throw_file_error(ImportStatus::invalid_input, path, ": its header states ", stated, " bytes, of which ", tables,
                         " for tables, and it has ", tile.size(), ". Copy or export it again.");
    }
    check_features(path, characters.substr(header_bytes, field(tile, feature_json)));
    const std::span<const std::byte> glb = tile.subspan(header_bytes + tables, stated - header_bytes - tables);
    // A tile is padded to a multiple of 8 bytes, binary glTF to one of 4: what is left over is no part of it.
    const std::uint64_t length = glb.size() < 12 ? glb.size() : field(glb, tile_bytes);
    return length < glb.size() && glb.size() - length < 8 ? glb.first(length) : glb;
}

}  // namespace espalier::importer
