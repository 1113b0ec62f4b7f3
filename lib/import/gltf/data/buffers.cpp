#include <import/gltf/data/accessors.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include <import/base/numbers.hpp>
#include <import/platform/files.hpp>

namespace espalier::importer {

namespace {

int value_of_digit(char digit) {
    if (digit >= '0' && digit <= '9') return digit - '0';
    if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
    return digit >= 'A' && digit <= 'F' ? digit - 'A' + 10 : -1;
}

/// "%20" in a URI is a space.
std::string without_percents(const std::string& uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? value_of_digit(uri[i + 1]) : -1;
        const int low = high >= 0 ? value_of_digit(uri[i + 2]) : -1;
        if (low < 0) {
            result += uri[i];
        } else {
            result += static_cast<char>(high * 16 + low);
            i += 2;
        }
    }
    return result;
}

/// Returns 64 for what is no digit.
std::uint32_t digit_value(char digit) {
    if (digit >= 'A' && digit <= 'Z') return static_cast<std::uint32_t>(digit - 'A');
    if (digit >= 'a' && digit <= 'z') return static_cast<std::uint32_t>(digit - 'a' + 26);
    if (digit >= '0' && digit <= '9') return static_cast<std::uint32_t>(digit - '0' + 52);
    if (digit == '+') return 62;
    return digit == '/' ? 63 : 64;
}

/// Returns nothing unless the whole text is base64 of RFC 4648; '=' at its end may be missing.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> result;
    result.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    unsigned count = 0;
    for (const char digit : text) {
        const std::uint32_t value = digit_value(digit);
        if (value == 64) return std::nullopt;
        bits = bits << 6 | value;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        result.push_back(static_cast<std::byte>(bits >> count & 0xffu));
    }
    return result;
}

}  // namespace

GltfData::GltfData(const std::string& path, const GltfContainer& container, std::vector<std::string>& opened)
    : path_(path),
      container_(container),
      opened_(opened),
      root_(*container.json, text("'", printable(path), "'")),
      buffers_(root_.size_of("buffers")) {}

std::span<const std::byte> GltfData::buffer(std::size_t number) {
    const GltfObject buffer = root_.object_in("buffers", number, text(root_.words(), ", buffer ", number));
    const std::uint64_t length = buffer.required_whole("byteLength");
    std::span<const std::byte> found;
    if (buffers_[number]) {
        found = *buffers_[number];
    } else if (const std::string uri = buffer.text_of("uri"); uri.empty()) {
        if (number != 0 || container_.binary.empty()) buffer.fail("it has no \"uri\", and the file no chunk for it");
        found = container_.binary;
    } else {
        buffers_[number] = bytes_beside(buffer, uri, length);
        found = *buffers_[number];
    }
    if (found.size() < length) {
        buffer.fail(text("it has ", found.size(), " bytes of the ", length, " that \"byteLength\" states"));
    }
    return found.first(length);
}

std::vector<std::byte> GltfData::bytes_beside(const GltfObject& buffer, const std::string& uri, std::uint64_t length) {
    if (uri.starts_with("data:")) {
        const std::size_t start = uri.find(";base64,");
        if (start == std::string::npos) buffer.fail("its data is not base64");
        auto bytes = decode_base64(std::string_view(uri).substr(start + 8));
        if (!bytes) buffer.fail("its base64 is broken");
        return std::move(*bytes);
    }
    const std::string shown = printable(uri.substr(0, 160));
    if (uri.find("://") != std::string::npos) {
        buffer.refuse(text("its bytes are at ", shown, ". Download them, and name the file in \"uri\"."));
    }
    const std::filesystem::path file_beside = path_of(path_).parent_path() / path_of(without_percents(uri));
    const std::string beside = text_of(file_beside);
    std::error_code error;
    const char* problem = nullptr;
    std::vector<std::byte> bytes;
    ImportStatus code = ImportStatus::file_access;
    if (!std::filesystem::is_regular_file(file_beside, error)) {
        problem = error ? std::strerror(error.value()) : "it is no file";
    } else if (InputFile file(file_beside); file.error() != 0) {
        problem = std::strerror(file.error());
    } else if (file.size() < length) {
        problem = "it is shorter than \"byteLength\"";
        code = ImportStatus::invalid_input;
    } else {
        bytes.resize(length);
        bytes.resize(file.read(bytes));
        if (file.error() != 0) problem = std::strerror(file.error());
    }
    if (problem != nullptr) {
        throw_error(code, buffer.words(), ": cannot read '", printable(beside), "': ", problem,
                    ". Put the whole file beside the glTF file.");
    }
    if (std::find(opened_.begin(), opened_.end(), beside) == opened_.end()) opened_.push_back(beside);
    return bytes;
}

GltfBufferView GltfData::view(std::size_t number) {
    const GltfObject view = root_.object_in("bufferViews", number, text(root_.words(), ", bufferView ", number));
    const std::size_t stride = view.whole("byteStride").value_or(0);
    const auto compressed = view.extension("EXT_meshopt_compression");
    if (!compressed) return {part_of_buffer(view), stride};
    const std::uint64_t packed = compressed->required_whole("byteStride");
    if (view.has("byteStride") && stride != packed) {
        view.fail(text("its byteStride is ", stride, ", and that of its EXT_meshopt_compression is ", packed));
    }
    auto found = decompressed_.find(number);
    if (found == decompressed_.end()) {
        found = decompressed_.emplace(number, decode_meshopt(*compressed, part_of_buffer(*compressed))).first;
    }
    const std::uint64_t length = view.required_whole("byteLength");
    if (found->second.size() != length) {
        view.fail(text("its \"byteLength\" is ", length, ", and its EXT_meshopt_compression has ", found->second.size(),
                       " bytes"));
    }
    return {found->second, stride, packed};
}

std::span<const std::byte> GltfData::part_of_buffer(const GltfObject& part) {
    const std::size_t number = part.required_index("buffer", buffers_.size());
    const std::uint64_t offset = part.whole("byteOffset").value_or(0);
    const std::uint64_t length = part.required_whole("byteLength");
    const std::span<const std::byte> buffer = this->buffer(number);
    if (offset > buffer.size() || length > buffer.size() - offset) {
        part.fail(text("its ", length, " bytes from byte ", offset, " on are not inside of the ", buffer.size(),
                       " bytes of buffer ", number));
    }
    return buffer.subspan(offset, length);
}

}  // namespace espalier::importer
