// Which format a file is of: by its content where that is enough, else by its name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::importer {

/// Those that the command reads itself.
enum class MeshFormat : std::uint8_t { obj, off, ply, stl, raw, gltf, three_mf };

/// How many bytes of a file the functions below need.
inline constexpr std::size_t format_begin_bytes = 1 << 16;

/// Returns the format with this name, or of files with this ending: "stl". Nothing for another one.
std::optional<MeshFormat> format_named(std::string_view name);

/// Returns the format that a file of `size` bytes declares with its first bytes, whatever its name is: PLY, OFF, binary
/// glTF, b3dm, STL, 3MF. RAW has no mark, and JSON and OBJ are common to many formats.
std::optional<MeshFormat> format_of_content(std::string_view begin, std::uint64_t size);

/// Tests whether the first lines are Wavefront OBJ and nothing else: what a file without a name of its own must show.
bool looks_like_obj(std::string_view begin, std::uint64_t size);

/// Throws ImportError (invalid_input) for a file whose ending is that of `named` and that looks like another format. To
/// call for content that declares none.
void refuse_wrong_ending(const std::string& path, std::string_view begin, std::uint64_t size, MeshFormat named);

/// Throws ImportError for a file that contains no mesh: (unsupported) a blob, a scene or a zipped AMF, (invalid_input)
/// a pointer of Git LFS or a web page.
void refuse_other_than_mesh(const std::string& path, std::string_view begin);

}  // namespace espalier::importer
