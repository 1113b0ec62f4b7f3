#include "buffers.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/numbers.hpp"
#include "base64.hpp"
#include "platform/input_file.hpp"
#include "platform/paths.hpp"

namespace espalier::tools {

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

}  // namespace

GltfBuffers::GltfBuffers(const std::string& path, const GltfContainer& container, std::vector<std::string>& opened)
    : path_(path),
      container_(container),
      opened_(opened),
      root_(*container.json, text("'", printable(path), "'")),
      buffers_(root_.size_of("buffers")) {}

std::span<const std::byte> GltfBuffers::bytes(std::size_t number) {
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

std::vector<std::byte> GltfBuffers::bytes_beside(const GltfObject& buffer, const std::string& uri,
                                                 std::uint64_t length) {
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
    ExitCode code = ExitCode::file_access;
    if (!std::filesystem::is_regular_file(file_beside, error)) {
        problem = error ? std::strerror(error.value()) : "it is no file";
    } else if (InputFile file(file_beside); file.error() != 0) {
        problem = std::strerror(file.error());
    } else if (file.size() < length) {
        problem = "it is shorter than \"byteLength\"";
        code = ExitCode::invalid_input;
    } else {
        bytes.resize(length);
        bytes.resize(file.read(bytes));
        if (file.error() != 0) problem = std::strerror(file.error());
    }
    if (problem != nullptr) {
        throw CommandError(code, text(buffer.words(), ": cannot read '", printable(beside), "': ", problem,
                                      ". Put the whole file beside the glTF file."));
    }
    if (std::find(opened_.begin(), opened_.end(), beside) == opened_.end()) opened_.push_back(beside);
    return bytes;
}

}  // namespace espalier::tools
