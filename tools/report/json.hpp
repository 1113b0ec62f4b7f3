// A JSON document that is built up and printed. The library that writes JSON takes seconds to compile:
// only json.cpp includes it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <espalier/types.hpp>

namespace espalier::tools {

/// A value. The members of an object keep the order in which they were added.
class Json {
public:
    using Member = std::pair<std::string, Json>;

    Json(std::nullptr_t = nullptr);
    Json(bool value);
    Json(double value);
    Json(std::string value);
    Json(std::string_view value);
    Json(const char* value);
    Json(const void*) = delete;  // which would become true or false
    Json(const std::vector<std::string>& values);
    template <std::integral Number, std::size_t Count>
    Json(const Number (&values)[Count]) : Json(array()) {
        for (const Number value : values) push_back(value);
    }
    template <std::integral Number>
    Json(Number value) : Json(Whole{value < Number{}, static_cast<std::uint64_t>(value)}) {}
    /// An object if all values are lists of a text and a value, as in {{"min", 1}, {"max", 2}}; else a list of them.
    Json(std::initializer_list<Json> values);

    static Json array(std::initializer_list<Json> values = {});
    static Json object();

    [[nodiscard]] bool is_null() const;
    /// The member of that name; a new one if there is none. Null becomes an object.
    Json& operator[](std::string_view key);
    /// Adds members to an object, and replaces those that have the same names.
    void update(const Json& other);
    /// Appends to a list, and returns the element.
    Json& push_back(Json value);
    [[nodiscard]] const std::vector<Json>& elements() const;
    [[nodiscard]] const std::vector<Member>& members() const;

    /// The text of a string, and any other value as JSON in one line.
    [[nodiscard]] std::string plain() const;
    /// As JSON, in lines that are indented by two spaces for each level. Texts may hold bytes that are no UTF-8; they
    /// are replaced rather than refused.
    [[nodiscard]] std::string dump() const;

private:
    struct Whole {
        bool is_negative;
        std::uint64_t bits;
    };
    using Array = std::vector<Json>;
    using Object = std::vector<Member>;

    Json(Whole value);
    void append_to(std::string& text, std::size_t indentation) const;

    std::variant<std::nullptr_t, bool, Whole, double, std::string, Array, Object> value_;
};

bool is_utf8(const std::string& text);

/// Raised when a key is taken away or changes its meaning; keys may be added without.
inline constexpr int json_schema = 1;

/// An object that starts with the schema.
Json json_document();
/// A float as the shortest decimal that reads back as the same float; null for what JSON cannot say (inf, nan).
Json json_number(float value);
Json json_point(Vec3 value);
Json json_point(const Vec3d& value);
Json json_box(Vec3 min, Vec3 max);
/// Returns the document as it is printed, with a line's end.
std::string json_text(const Json& document);

}  // namespace espalier::tools
