#include <import/format.hpp>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include <import/base/error.hpp>
#include <import/base/git_lfs.hpp>
#include <import/base/text_file.hpp>
#include <import/base/web_page.hpp>

namespace espalier::importer {

namespace {

constexpr std::pair<std::string_view, MeshFormat> format_names[] = {
    {"obj", MeshFormat::obj},  {"off", MeshFormat::off},   {"ply", MeshFormat::ply},
    {"stl", MeshFormat::stl},  {"raw", MeshFormat::raw},   {"gltf", MeshFormat::gltf},
    {"glb", MeshFormat::gltf}, {"b3dm", MeshFormat::gltf}, {"3mf", MeshFormat::three_mf}};

/// In the order of MeshFormat.
constexpr std::string_view full_names[] = {"Wavefront OBJ", "OFF", "PLY", "STL", "RAW", "glTF", "3MF"};

/// What files of other formats begin with, and their endings.
struct Mark {
    std::string_view begin, name, ending;
};
constexpr Mark marks[] = {{"Kaydara FBX Binary", "FBX", "fbx"}, {"; FBX ", "FBX", "fbx"}, {"xof ", "DirectX", "x"}};

/// The statements that files of OBJ begin with.
constexpr std::string_view obj_words[] = {"v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "p", "usemtl", "mtllib"};
constexpr std::size_t judged_lines = 50;

/// Its size is that of the triangles that it states; its header may begin with any words, "solid" among them.
bool is_binary_stl(std::string_view begin, std::uint64_t size) {
    constexpr std::size_t header_bytes = 84, triangle_bytes = 50;
    if (begin.size() < header_bytes) return false;
    const std::uint64_t triangles = little_endian<std::uint32_t>(begin.data() + 80);
    return triangles > 0 && size == header_bytes + triangle_bytes * triangles;
}

/// The first words of a text without its comments, which begin with '#'.
std::array<std::string, 2> first_words(std::string_view begin) {
    std::array<std::string, 2> result;
    std::size_t count = 0;
    Lines lines(begin);
    for (std::string_view line; count < result.size() && lines.next(line);) {
        Words words(line);
        for (std::string_view word = words.next(); count < result.size() && !word.empty(); word = words.next()) {
            if (word.starts_with('#')) break;
            result[count++] = word.substr(0, 40);
        }
    }
    return result;
}

/// "OFF", "COFF" and others, and "OFF490": a number may follow without a space.
bool is_off_keyword(std::string_view word) {
    while (!word.empty() && std::string_view("STCN4n").find(word[0]) != std::string_view::npos) word.remove_prefix(1);
    if (!word.starts_with("OFF")) return false;
    return word.find_first_not_of("0123456789", 3) == std::string_view::npos;
}

/// Any name may follow "solid": a facet must be in sight.
bool is_text_stl(std::string_view begin) {
    const std::string lower = lower_case(begin);
    Lines lines(lower);
    for (std::string_view line; lines.next(line);) {
        const std::string_view first = Words(line).next();
        if (first.empty()) continue;
        if (first != "solid" && first != "facet") return false;
        if (first == "facet" || line.find(" facet normal ") != std::string_view::npos) return true;
    }
    return false;
}

bool is_vertex(Words& words) {
    for (int axis = 0; axis < 3; ++axis)
        if (!parse_coordinate(words.next())) return false;
    return true;
}

/// Returns the name of the first file in a zip archive; empty for other files.
std::string_view first_zipped(std::string_view begin) {
    constexpr std::size_t header_bytes = 30;
    if (!begin.starts_with("PK\3\4") || begin.size() < header_bytes) return {};
    return begin.substr(header_bytes, little_endian<std::uint16_t>(begin.data() + 26));
}

/// Programs write the parts of a package in any order. Other packages have some of the names too, and then no model.
bool is_package(std::string_view begin) {
    const std::string_view name = first_zipped(begin);
    return name == "[Content_Types].xml" || name.starts_with("_rels/") || name.starts_with("3D/") ||
           name.starts_with("Metadata/");
}

/// ISO 10303-21 in another schema than that of buildings, which assimp reads.
bool is_step_of_solids(std::string_view begin) {
    if (!begin.starts_with("ISO-10303-21")) return false;
    // At the start of a line: a comment or a name may have the word too.
    const std::size_t schema = begin.find("\nFILE_SCHEMA"), end = begin.find(';', std::min(schema, begin.size()));
    return end != std::string_view::npos && begin.substr(schema, end - schema).find("IFC") == std::string_view::npos;
}

}  // namespace

std::optional<MeshFormat> format_named(std::string_view name) {
    const auto* const found = std::find_if(std::begin(format_names), std::end(format_names),
                                           [name](const auto& known) { return known.first == name; });
    if (found == std::end(format_names)) return std::nullopt;
    return found->second;
}

std::optional<MeshFormat> format_of_content(std::string_view begin, std::uint64_t size) {
    if (begin.starts_with("ply\n") || begin.starts_with("ply\r")) return MeshFormat::ply;
    if (begin.starts_with("glTF") || begin.starts_with("b3dm")) return MeshFormat::gltf;
    if (is_package(begin)) return MeshFormat::three_mf;
    if (is_binary_stl(begin, size)) return MeshFormat::stl;
    const std::string text = utf8_text(std::string(begin));
    if (text.find('\0') != std::string::npos) return std::nullopt;
    const auto [first, second] = first_words(text);
    const bool is_counted = !second.empty() && second.find_first_not_of("0123456789") == std::string::npos;
    if (is_off_keyword(first) && (is_counted || second == "BINARY")) return MeshFormat::off;
    if (is_text_stl(text)) return MeshFormat::stl;
    return std::nullopt;
}

bool looks_like_obj(std::string_view begin, std::uint64_t size) {
    std::string text = utf8_text(std::string(begin));
    if (text.find('\0') != std::string::npos) return false;
    if (begin.size() < size) text.resize(std::min(text.size(), text.find_last_of("\r\n") + 1));  // whole lines
    bool has_vertex = false;
    std::size_t judged = 0;
    Lines lines(text);
    for (std::string_view line; judged < judged_lines && lines.next(line);) {
        Words words(line);
        const std::string_view word = words.next();
        if (word.empty() || word.starts_with('#')) continue;
        ++judged;
        if (std::find(std::begin(obj_words), std::end(obj_words), word) == std::end(obj_words)) return false;
        if (word == "v" && !is_vertex(words)) return false;
        has_vertex = has_vertex || word == "v";
    }
    return has_vertex;
}

void refuse_wrong_ending(const std::string& path, std::string_view begin, std::uint64_t size, MeshFormat named) {
    std::string_view name, ending;
    for (const Mark& mark : marks)
        if (begin.starts_with(mark.begin)) std::tie(name, ending) = std::tie(mark.name, mark.ending);
    if (begin.starts_with("<?xml") && begin.find("<COLLADA") != std::string_view::npos)
        name = "Collada", ending = "dae";
    if (named != MeshFormat::obj && looks_like_obj(begin, size)) name = full_names[0], ending = "obj";
    if (name.empty()) return;
    throw_file_error(ImportStatus::invalid_input, path, " is named as ", full_names[static_cast<std::size_t>(named)],
                     ", and looks like ", name, ". Read it with --format ", ending, ", or give it the ending .", ending,
                     '.');
}

void refuse_other_than_mesh(const std::string& path, std::string_view begin) {
    if (begin.starts_with("ESPL") || begin.starts_with("ESPS")) {
        throw_file_error(ImportStatus::unsupported, path, " is a ", begin[3] == 'L' ? "blob" : "scene",
                         " already. Give the mesh that it was baked from.");
    }
    if (is_git_lfs_pointer(begin)) {
        throw ImportError(ImportStatus::invalid_input, words_for_git_lfs_pointer(path),
                          {.file = path, .kind = "git_lfs_pointer"});
    }
    if (is_web_page(begin)) {
        throw ImportError(ImportStatus::invalid_input, words_for_web_page(path), {.file = path, .kind = "web_page"});
    }
    if (is_step_of_solids(begin)) {
        throw_file_error(ImportStatus::unsupported, path,
                         " is STEP, whose solids have exact surfaces and no triangles. Export it as STL, 3MF or glTF.");
    }
    const std::string_view zipped = first_zipped(begin);
    if (zipped.ends_with(".amf") || (!zipped.empty() && ending_of(path) == ".amf")) {
        throw_file_error(ImportStatus::unsupported, path,
                         " is a zipped AMF, and only the text is read. Unzip it, and give the file in it.");
    }
}

}  // namespace espalier::importer
