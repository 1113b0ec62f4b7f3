#include <import/gltf/data/container.hpp>

#include <cstdint>
#include <string_view>
#include <utility>

#include <import/base/error.hpp>
#include <import/base/text_file.hpp>
#include <import/gltf/data/json.hpp>
#include <import/gltf/data/tile.hpp>

namespace espalier::importer {

namespace {

constexpr std::size_t glb_header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4e4f534a;
constexpr std::uint32_t binary_chunk = 0x004e4942;
constexpr std::size_t longest_quotation = 160;

[[noreturn]] void fail(const std::string& path, std::string_view problem) {
    throw_error(ImportStatus::invalid_input, "'", printable(path), "' cannot be imported: ", problem);
}

/// Among others 1.0: assimp reads that, and misplaces nodes that are rotated.
[[noreturn]] void refuse_version(const std::string& path, const std::string& version) {
    throw_error(ImportStatus::unsupported, "'", printable(path), "' cannot be imported: it is glTF ",
                printable(version), ", and 2.0 is read. Convert it to glTF 2.0.");
}

enum class Content { binary, tile, json, other };

Content content_of(std::string_view start) {
    if (start.starts_with("glTF")) return Content::binary;
    if (is_tile(start)) return Content::tile;
    if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
    const std::size_t first = start.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && start[first] == '{' ? Content::json : Content::other;
}

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t result = 0;
    for (std::size_t i = 4; i-- > 0;) result = result << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return result;
}

std::string_view characters(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Chunks {
    std::span<const std::byte> json, binary;
    std::size_t trailing_bytes = 0;
};

Chunks chunks_of(const std::string& path, std::span<const std::byte> file) {
    const std::uint64_t length = word_at(file, 8);
    if (length > file.size()) {
        fail(path, text("it has ", file.size(), " bytes of the ", length,
                        " that its header states. It is cut off; copy or export it again."));
    }
    Chunks chunks;
    if (length < glb_header_bytes)
        fail(path, text("its header states a length of ", length, " bytes. Export it again."));
    std::span<const std::byte> rest = file.first(length).subspan(glb_header_bytes);
    for (bool first = true; rest.size() >= chunk_header_bytes; first = false) {
        const std::uint32_t bytes = word_at(rest, 0);
        const std::uint32_t type = word_at(rest, 4);
        rest = rest.subspan(chunk_header_bytes);
        if (bytes > rest.size()) {
            fail(path, text("a chunk of it ends behind the ", length,
                            " bytes that its header states. Is it whole? Copy or export it again."));
        }
        if (first && type == json_chunk) chunks.json = rest.first(bytes);
        if (!first && type == binary_chunk && chunks.binary.empty()) chunks.binary = rest.first(bytes);
        rest = rest.subspan(bytes);
    }
    chunks.trailing_bytes = rest.size() + (file.size() - length);
    if (chunks.json.empty()) fail(path, "its first chunk is no JSON. The file is broken; export it again.");
    return chunks;
}

/// Without the megabytes that a file may have.
std::string quoted(std::string words) {
    if (words.size() > longest_quotation) words.replace(longest_quotation, std::string::npos, "...");
    return printable(words);
}

/// The parser's reason without its own number.
std::string without_number(std::string reason) {
    if (const std::size_t end = reason.find("] "); reason.starts_with('[') && end != std::string::npos) {
        reason.erase(0, end + 2);
    }
    return quoted(std::move(reason));
}

[[noreturn]] void refuse_repeated_key(const std::string& path, const RepeatedKey& repeated) {
    const std::string object = repeated.object.empty() ? "" : text(", at ", quoted(repeated.object));
    fail(path, text("its JSON has the key \"", quoted(repeated.key), "\" twice in one object", object,
                    ", and only one of the two can count. Export it again."));
}

}  // namespace

std::optional<GltfContainer> read_gltf_container(const std::string& path, bool named_so) {
    constexpr std::size_t start_bytes = 4096;
    const Content content = content_of(read_begin(path, start_bytes));
    if (content == Content::other) {
        if (!named_so) return std::nullopt;
        fail(path,
             "it is named as a glTF file, and is neither JSON nor binary glTF. Give it the ending of its format.");
    }
    GltfContainer container;
    container.file = read_byte_list(path);
    std::span<const std::byte> json = container.file;
    container.format = "glTF 2.0";
    if (content == Content::binary || content == Content::tile) {
        if (content == Content::tile) json = glb_of_tile(path, json);
        if (json.size() < glb_header_bytes) {
            fail(path, text("it has ", json.size(), " bytes, and the header of binary glTF alone has ",
                            glb_header_bytes, ". Copy or export it again."));
        }
        const std::uint32_t version = word_at(json, 4);
        if (version != 2) refuse_version(path, version == 1 ? "1.0" : text(version));
        const Chunks chunks = chunks_of(path, json);
        json = chunks.json;
        container.binary = chunks.binary;
        container.trailing_bytes = chunks.trailing_bytes;
        container.format = content == Content::tile ? "glTF 2.0 in b3dm" : "glTF 2.0 binary";
    }
    ParsedJson parsed = parse_json(characters(json));
    if (parsed.value == nullptr) {
        if (!named_so && content == Content::json) return std::nullopt;
        fail(path, text("its JSON is broken: ", without_number(std::move(parsed.problem)), ". Export it again."));
    }
    container.json = std::move(parsed.value);
    const std::string version = text_in_object(*container.json, "asset", "version");
    const std::string least = text_in_object(*container.json, "asset", "minVersion");
    if (version.empty() && !named_so && content == Content::json) return std::nullopt;
    // glTF 1.0 names its elements where 2.0 numbers them, and need not state its version.
    if (version.empty() && has_object(*container.json, "meshes")) refuse_version(path, "1.0");
    if (version.empty()) fail(path, "its JSON has no asset.version, which glTF requires. Export it again.");
    if (!version.starts_with("2.")) refuse_version(path, version);
    if (!least.empty() && least != "2.0") refuse_version(path, least);
    if (parsed.repeated) refuse_repeated_key(path, *parsed.repeated);
    if (content == Content::json) container.file = {};
    return container;
}

}  // namespace espalier::importer
