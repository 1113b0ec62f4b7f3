// The JSON of a glTF file, read with checks: a member of another type than the specification's is an error by name.
// The library that parses it takes seconds to compile: only json.cpp includes it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <import/base/error.hpp>

namespace espalier::importer {

/// A key that an object has twice, of which readers differ in which one counts. The object is named by its path,
/// "meshes[0].primitives[1]", which is empty for the outermost one.
struct RepeatedKey {
    std::string key;
    std::string object;
};

/// The value that a JSON text is, or why it is none; and the first key in it that is repeated, if any.
struct ParsedJson {
    std::shared_ptr<const nlohmann::json> value;
    std::string problem;
    std::optional<RepeatedKey> repeated;
};
ParsedJson parse_json(std::string_view json);

/// Return whether a value has this object, and the text in it, which is empty where it has none.
bool has_object(const nlohmann::json& value, const char* object);
std::string text_in_object(const nlohmann::json& value, const char* object, const char* key);

/// An object of the file, and the words that name it in messages: "'level.glb', mesh 3 (walls)". The JSON outlives it.
class GltfObject {
public:
    GltfObject(const nlohmann::json& json, std::string words);

    [[nodiscard]] const std::string& words() const { return words_; }
    [[nodiscard]] bool has(const char* key) const;

    /// Returns the member, or nothing when it is absent. Throws ImportError when it is no whole number from 0 on.
    [[nodiscard]] std::optional<std::uint64_t> whole(const char* key) const;
    [[nodiscard]] std::uint64_t required_whole(const char* key) const;
    /// Returns the member, which numbers an element of a list of `count`. Throws ImportError beyond the list.
    [[nodiscard]] std::optional<std::size_t> index(const char* key, std::size_t count) const;
    [[nodiscard]] std::size_t required_index(const char* key, std::size_t count) const;
    /// Returns an empty text when the member is absent.
    [[nodiscard]] std::string text_of(const char* key) const;
    [[nodiscard]] bool flag(const char* key) const;
    /// Returns the numbers of an array, or nothing when it is absent. Throws ImportError unless there are `Count`.
    template <std::size_t Count>
    [[nodiscard]] std::optional<std::array<double, Count>> numbers(const char* key) const {
        if (!has(key)) return std::nullopt;
        std::array<double, Count> result{};
        if (size_of(key) != Count) fail_at(key, "has not " + std::to_string(Count) + " numbers");
        for (std::size_t i = 0; i < Count; ++i) result[i] = number_in(key, i);
        return result;
    }

    /// Returns the member, or nothing when it is absent. Throws ImportError when it is no object.
    [[nodiscard]] std::optional<GltfObject> object(const char* key) const;
    /// Returns extensions.<name>, or nothing when it is absent.
    [[nodiscard]] std::optional<GltfObject> extension(const char* name) const;

    /// Returns how many elements the array has: 0 when it is absent.
    [[nodiscard]] std::size_t size_of(const char* key) const;
    /// Return the element of an array that has it. Throw ImportError when it has another type.
    [[nodiscard]] GltfObject object_in(const char* key, std::size_t element, std::string words) const;
    [[nodiscard]] std::size_t index_in(const char* key, std::size_t element, std::size_t count) const;
    [[nodiscard]] double number_in(const char* key, std::size_t element) const;
    [[nodiscard]] std::string text_in(const char* key, std::size_t element) const;
    /// Returns the member "name" of each element, empty where it has none or is no object.
    [[nodiscard]] std::vector<std::string> names_in(const char* key) const;

    /// Throws ImportError: the words, `problem`, and what to do about a broken file.
    [[noreturn]] void fail(std::string_view problem) const;
    /// Throws ImportError (unsupported): the words and `problem`, which contains what to do.
    [[noreturn]] void refuse(std::string_view problem) const;

private:
    [[nodiscard]] const nlohmann::json& list(const char* key) const;
    [[noreturn]] void fail_at(const char* key, std::string_view problem) const;

    const nlohmann::json* json_;
    std::string words_;
};

}  // namespace espalier::importer
