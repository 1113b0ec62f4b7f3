#include "json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include <import/base/numbers.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

using Library = nlohmann::json;

std::string written(const Library& scalar) { return scalar.dump(-1, ' ', false, Library::error_handler_t::replace); }

}  // namespace

Json::Json(std::nullptr_t) : value_(nullptr) {}
Json::Json(bool value) : value_(value) {}
Json::Json(double value) : value_(value + 0.0) {}  // 0 for -0
Json::Json(std::string value) : value_(std::move(value)) {}
Json::Json(std::string_view value) : value_(std::string(value)) {}
Json::Json(const char* value) : value_(std::string(value)) {}
Json::Json(const std::vector<std::string>& values) : value_(Array(values.begin(), values.end())) {}
Json::Json(Whole value) : value_(value) {}

Json::Json(std::initializer_list<Json> values) {
    const auto is_member = [](const Json& value) {
        const auto* list = std::get_if<Array>(&value.value_);
        return list != nullptr && list->size() == 2 && std::holds_alternative<std::string>(list->front().value_);
    };
    if (!std::all_of(values.begin(), values.end(), is_member)) {
        value_ = Array(values);
        return;
    }
    auto& members = value_.emplace<Object>();
    for (const Json& value : values) {
        const auto& list = std::get<Array>(value.value_);
        members.emplace_back(std::get<std::string>(list.front().value_), list.back());
    }
}

Json Json::array(std::initializer_list<Json> values) {
    Json result;
    result.value_ = Array(values);
    return result;
}

Json Json::object() {
    Json result;
    result.value_ = Object();
    return result;
}

bool Json::is_null() const { return std::holds_alternative<std::nullptr_t>(value_); }

Json& Json::operator[](std::string_view key) {
    if (is_null()) value_ = Object();
    auto& members = std::get<Object>(value_);
    const auto has_name = [key](const Member& member) { return member.first == key; };
    const auto found = std::find_if(members.begin(), members.end(), has_name);
    return found != members.end() ? found->second : members.emplace_back(key, nullptr).second;
}

void Json::update(const Json& other) {
    for (const auto& [key, value] : other.members()) (*this)[key] = value;
}

Json& Json::push_back(Json value) { return std::get<Array>(value_).emplace_back(std::move(value)); }
const std::vector<Json>& Json::elements() const { return std::get<Array>(value_); }
const std::vector<Json::Member>& Json::members() const { return std::get<Object>(value_); }

std::string Json::plain() const {
    if (const auto* text = std::get_if<std::string>(&value_)) return *text;
    return dump();
}

std::string Json::dump() const {
    std::string text;
    append_to(text, 0);
    return text;
}

void Json::append_to(std::string& text, std::size_t indentation) const {
    const auto append_all = [&](const auto& values, char begin, char end, const auto& append) {
        text += begin;
        for (const auto& value : values) {
            text += &value == values.data() ? "\n" : ",\n";
            text.append(indentation + 2, ' ');
            append(value);
        }
        if (!values.empty()) text.append(1, '\n').append(indentation, ' ');
        text += end;
    };
    if (const auto* object = std::get_if<Object>(&value_)) {
        append_all(*object, '{', '}', [&](const Member& member) {
            text += written(member.first) + ": ";
            member.second.append_to(text, indentation + 2);
        });
    } else if (const auto* list = std::get_if<Array>(&value_)) {
        append_all(*list, '[', ']', [&](const Json& element) { element.append_to(text, indentation + 2); });
    } else if (const auto* whole = std::get_if<Whole>(&value_)) {
        text +=
            whole->is_negative ? std::to_string(static_cast<std::int64_t>(whole->bits)) : std::to_string(whole->bits);
    } else if (const auto* number = std::get_if<double>(&value_)) {
        text += written(*number);
    } else if (const auto* string = std::get_if<std::string>(&value_)) {
        text += written(*string);
    } else {
        text += is_null() ? "null" : std::get<bool>(value_) ? "true" : "false";
    }
}

bool is_utf8(const std::string& text) {
    try {
        static_cast<void>(Library(text).dump());
        return true;
    } catch (const Library::type_error&) {
        return false;
    }
}

Json json_document() { return Json{{"schema", json_schema}}; }

Json json_number(float value) {
    if (!std::isfinite(value)) return nullptr;
    return *parse_double(shortest(value));
}

Json json_point(Vec3 value) { return Json::array({json_number(value.x), json_number(value.y), json_number(value.z)}); }

Json json_point(const Vec3d& value) { return Json::array({value.x, value.y, value.z}); }

Json json_box(Vec3 min, Vec3 max) { return {{"min", json_point(min)}, {"max", json_point(max)}}; }

std::string json_text(const Json& document) { return document.dump() + '\n'; }

}  // namespace espalier::tools
