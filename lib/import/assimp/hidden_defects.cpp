#include <import/assimp/steps.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <import/base/error.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

/// The vertices of one mesh of a text, and the index of its faces that is furthest outside.
class Indices {
public:
    explicit Indices(const ImportedFile& file) : file_(file) {}

    void add_vertex() { ++vertices_; }
    void add(std::string_view word, std::uint64_t line) {
        const std::optional<std::int64_t> index = parse_integer(word);
        if (!index) refuse_line(file_.path, line, text("'", printable(word), "' is not the index of a vertex."));
        if (*index < 0) refuse_line(file_.path, line, text("a face has vertex ", *index, ", below 0."));
        if (largest_ >= *index) return;
        largest_ = *index;
        line_ = line;
    }
    /// Throws when an index is beyond the vertices, and begins the next mesh.
    void end() {
        if (largest_ >= static_cast<std::int64_t>(vertices_)) {
            refuse_line(file_.path, line_,
                        text("a face has vertex ", largest_, ", and its mesh has ", vertices_,
                             " from 0. Export the file again, for example as glTF."));
        }
        vertices_ = 0;
        largest_ = -1;
    }

private:
    const ImportedFile& file_;
    std::uint64_t vertices_ = 0;
    std::int64_t largest_ = -1;
    std::uint64_t line_ = 0;
};

/// "*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1": assimp gives an index that is too large a vertex of its own making.
void check_ase(const ImportedFile& file) {
    const std::string content = utf8_text(read_bytes(file.path));
    Lines lines(content);
    Indices indices(file);
    for (std::string_view line; lines.next(line);) {
        Words words(line);
        const std::string_view key = words.next();
        if (key == "*MESH_NUMVERTEX") indices.end();
        if (key == "*MESH_VERTEX") indices.add_vertex();
        if (key != "*MESH_FACE") continue;
        for (const char* corner : {"A:", "B:", "C:"}) {
            const std::size_t at = line.find(corner);
            if (at != std::string_view::npos) indices.add(Words(line.substr(at + 2)).next(), lines.number());
        }
    }
    indices.end();
}

/// <sharedgeometry> and <submesh> with <vertex> and <face v1= v2= v3=>: assimp reads beyond the vertices.
void check_ogre_xml(const ImportedFile& file) {
    const std::string content = utf8_text(read_bytes(file.path));
    const std::string_view xml(content);
    Indices shared(file), own(file);
    Indices* faces = &own;
    Indices* vertices = &own;
    std::uint64_t line = 1;
    std::size_t counted_to = 0;
    for (std::size_t at = xml.find('<'); at != std::string_view::npos; at = xml.find('<', at + 1)) {
        line += static_cast<std::uint64_t>(std::count(xml.begin() + static_cast<std::ptrdiff_t>(counted_to),
                                                      xml.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
        counted_to = at;
        const std::string_view tag = xml.substr(at + 1, xml.find('>', at) - at - 1);
        const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/", 1));
        if (name == "sharedgeometry") vertices = &shared;
        if (name == "/sharedgeometry") vertices = &own;
        if (name == "submesh") faces = tag_attribute(tag, "usesharedvertices") == "false" ? &own : &shared;
        if (name == "/submesh") own.end();
        if (name == "position") vertices->add_vertex();
        if (name != "face") continue;
        for (const char* corner : {"v1", "v2", "v3"}) {
            const std::string_view word = tag_attribute(tag, corner);
            if (!word.empty()) faces->add(word, line);
        }
    }
    shared.end();
}

/// The last line with more than spaces, without them and without comments of `//`.
std::string last_line(const ImportedFile& file) {
    const std::string content = utf8_text(read_bytes(file.path));
    Lines lines(content);
    std::string last;
    for (std::string_view line; lines.next(line);) {
        const std::string_view words = Words(line).rest();
        if (!words.empty() && !words.starts_with("//")) last = words;
    }
    return last;
}

void require_last_line(ImportedFile& file, const char* end) {
    if (last_line(file) == end) return;
    add_warning(file, "missing_end",
                text("'", printable(file.path), "': the file does not end with '", end, "'. Is it whole?"));
}

/// FORM, its size, LWO2, and chunks of an id, a size and so many bytes, made even. Each POLS replaces the last in its
/// layer.
void check_lwo(const ImportedFile& file) {
    const std::string content = read_bytes(file.path);
    std::string_view chunks(content);
    if (chunks.size() < 12 || chunks.substr(8, 4) == "LWOB") return;
    chunks.remove_prefix(12);
    unsigned lists = 0;
    for (unsigned layer = 0; chunks.size() >= 8;) {
        const std::string_view id = chunks.substr(0, 4);
        const std::uint64_t size = stored_number<std::uint32_t>(chunks.data() + 4, std::endian::big);
        if (id == "LAYR") {
            ++layer;
            lists = 0;
        }
        if (id == "POLS" && ++lists > 1) {
            throw_file_error(ImportStatus::unsupported, file.path, ", layer ", layer,
                             ": it has more than one list of polygons (POLS), and the importer would keep only "
                             "the last. Export it as glTF or OBJ.");
        }
        chunks.remove_prefix(std::min<std::uint64_t>(chunks.size(), 8 + size + size % 2));
    }
}

/// "numsurf 2" and so many lines of "SURF 0x20": assimp reads no more than are stated.
void check_ac3d(ImportedFile& file) {
    const std::string content = utf8_text(read_bytes(file.path));
    Lines lines(content);
    constexpr std::int64_t most = std::int64_t{1} << 32;  // of one object, so that no sum overflows
    std::uint64_t found = 0;
    std::uint64_t stated = 0;
    for (std::string_view line; lines.next(line);) {
        Words words(line);
        const std::string_view key = words.next();
        if (key == "SURF") ++found;
        if (key == "numsurf") {
            const std::int64_t count = parse_integer(words.next()).value_or(0);
            stated += static_cast<std::uint64_t>(std::clamp<std::int64_t>(count, 0, most));
        }
    }
    if (found == stated) return;
    add_warning(file, "surface_count",
                text("'", printable(file.path), "': it has ", counted(found, "surface"),
                     ", and its lines of 'numsurf' state ", stated, ": triangles may be missing."));
}

constexpr std::string_view spaces = " \t\r\n";

bool is_xml_space(char letter) { return spaces.find(letter) != std::string_view::npos; }

}  // namespace

void find_hidden_defects(ImportedFile& file) {
    const auto is_format = [&file](const char* name) { return file.format.find(name) != std::string::npos; };
    if (is_format("ASE ")) check_ase(file);
    if (is_format("Ogre") && file.path.ends_with(".xml")) check_ogre_xml(file);
    if (is_format("AC3D")) check_ac3d(file);
    if (is_format("SMD")) require_last_line(file, "end");
    if (is_format("DXF")) require_last_line(file, "EOF");
    if (is_format("LightWave") && !is_format("Scene")) check_lwo(file);
}

std::string_view tag_attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name, 1); at != std::string_view::npos; at = tag.find(name, at + 1)) {
        const std::size_t equals = tag.find_first_not_of(spaces, at + name.size());
        if (!is_xml_space(tag[at - 1]) || equals == std::string_view::npos || tag[equals] != '=') continue;
        const std::size_t quote = tag.find_first_not_of(spaces, equals + 1);
        if (quote == std::string_view::npos) break;
        const std::size_t end = tag.find(tag[quote], quote + 1);
        if (end != std::string_view::npos) return tag.substr(quote + 1, end - quote - 1);
    }
    return {};
}

std::string_view xml_attribute(std::string_view text, std::string_view element, std::string_view name) {
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
        const std::string_view tag = text.substr(at + 1, text.find('>', at) - at - 1);
        const std::size_t length = tag.find_first_of(" \t\r\n/");
        if (tag.substr(0, length) == element) return tag_attribute(tag, name);
    }
    return {};
}

}  // namespace espalier::importer
