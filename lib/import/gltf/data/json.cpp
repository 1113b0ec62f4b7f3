#include <import/gltf/data/json.hpp>

#include <cmath>
#include <deque>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

/// Some exporters write whole numbers with a fraction of zero.
std::optional<std::uint64_t> whole_number(const nlohmann::json& json) {
    if (json.is_number_unsigned()) return json.get<std::uint64_t>();
    if (!json.is_number_float()) return std::nullopt;
    const auto value = json.get<double>();
    if (!(value >= 0.0 && value < 9007199254740992.0) || std::floor(value) != value) return std::nullopt;
    return static_cast<std::uint64_t>(value);
}

/// An object that is open, whose last key is `key`, or a list, of which `element` values are read.
struct OpenValue {
    std::set<std::string> keys = {};
    const std::string* key = nullptr;
    std::uint64_t element = 0;
};

/// Finds the first key that an object has twice. The library's parser, given such a visitor, searches all of a list
/// behind each of its elements: the text is read once more here.
class RepeatedKeyFinder : public nlohmann::json_sax<nlohmann::json> {
public:
    std::optional<RepeatedKey> found;

    bool null() override { return end_value(); }
    bool boolean(bool) override { return end_value(); }
    bool number_integer(number_integer_t) override { return end_value(); }
    bool number_unsigned(number_unsigned_t) override { return end_value(); }
    bool number_float(number_float_t, const string_t&) override { return end_value(); }
    bool string(string_t&) override { return end_value(); }
    bool binary(binary_t&) override { return end_value(); }
    bool start_object(std::size_t) override { return begin_value(); }
    bool start_array(std::size_t) override { return begin_value(); }
    bool end_object() override { return end_list(); }
    bool end_array() override { return end_list(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

    bool key(string_t& name) override {
        const auto [place, is_new] = open_.back().keys.insert(name);
        open_.back().key = &*place;
        if (!is_new) found = {name, path()};
        return is_new;
    }

private:
    bool begin_value() {
        open_.emplace_back();
        return true;
    }
    bool end_list() {
        open_.pop_back();
        return end_value();
    }
    bool end_value() {
        if (!open_.empty()) ++open_.back().element;
        return true;
    }

    /// Returns "meshes[0].primitives[1]" for the innermost object.
    [[nodiscard]] std::string path() const {
        std::string result;
        for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
            const OpenValue& value = open_[i];
            result += value.key == nullptr ? text('[', value.element, ']') : text(i == 0 ? "" : ".", *value.key);
        }
        return result;
    }

    std::deque<OpenValue> open_;  // which keeps the places of keys
};

}  // namespace

ParsedJson parse_json(std::string_view json) {
    try {
        ParsedJson parsed{std::make_shared<const nlohmann::json>(nlohmann::json::parse(json)), {}, {}};
        RepeatedKeyFinder finder;
        nlohmann::json::sax_parse(json, &finder);
        parsed.repeated = finder.found;
        return parsed;
    } catch (const nlohmann::json::exception& error) {
        return {nullptr, error.what(), {}};
    }
}

bool has_object(const nlohmann::json& value, const char* object) {
    return value.is_object() && value.contains(object) && value[object].is_object();
}

std::string text_in_object(const nlohmann::json& value, const char* object, const char* key) {
    if (!has_object(value, object)) return {};
    const nlohmann::json& members = value[object];
    return members.contains(key) && members[key].is_string() ? members[key].get<std::string>() : std::string();
}

GltfObject::GltfObject(const nlohmann::json& json, std::string words) : json_(&json), words_(std::move(words)) {
    if (!json.is_object()) fail("it is no object");
}

bool GltfObject::has(const char* key) const { return json_->contains(key); }

std::optional<std::uint64_t> GltfObject::whole(const char* key) const {
    if (!has(key)) return std::nullopt;
    const auto value = whole_number((*json_)[key]);
    if (!value) fail_at(key, "is no whole number from 0 on");
    return value;
}

std::uint64_t GltfObject::required_whole(const char* key) const {
    const auto value = whole(key);
    if (!value) fail_at(key, "is missing");
    return *value;
}

std::optional<std::size_t> GltfObject::index(const char* key, std::size_t count) const {
    const auto value = whole(key);
    if (value && *value >= count) fail_at(key, text("is ", *value, ", and the file has ", count, " of them"));
    return value;
}

std::size_t GltfObject::required_index(const char* key, std::size_t count) const {
    const auto value = index(key, count);
    if (!value) fail_at(key, "is missing");
    return *value;
}

std::string GltfObject::text_of(const char* key) const {
    if (!has(key) || !(*json_)[key].is_string()) return {};
    return (*json_)[key].get<std::string>();
}

bool GltfObject::flag(const char* key) const {
    if (!has(key)) return false;
    if (!(*json_)[key].is_boolean()) fail_at(key, "is neither true nor false");
    return (*json_)[key].get<bool>();
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
    if (!has(key)) return std::nullopt;
    return GltfObject((*json_)[key], text(words_, ", ", key));
}

std::optional<GltfObject> GltfObject::extension(const char* name) const {
    const auto extensions = object("extensions");
    if (!extensions) return std::nullopt;
    if (!extensions->has(name)) return std::nullopt;
    return GltfObject((*extensions->json_)[name], text(words_, ", ", name));
}

std::size_t GltfObject::size_of(const char* key) const { return has(key) ? list(key).size() : 0; }

GltfObject GltfObject::object_in(const char* key, std::size_t element, std::string words) const {
    return {list(key)[element], std::move(words)};
}

std::size_t GltfObject::index_in(const char* key, std::size_t element, std::size_t count) const {
    const auto value = whole_number(list(key)[element]);
    if (!value) fail_at(key, "has an element that is no whole number from 0 on");
    if (*value >= count) fail_at(key, text("has the element ", *value, ", and the file has ", count, " of them"));
    return *value;
}

std::vector<std::string> GltfObject::names_in(const char* key) const {
    std::vector<std::string> names(size_of(key));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const nlohmann::json& element = list(key)[i];
        if (element.is_object() && element.contains("name") && element["name"].is_string())
            names[i] = element["name"].get<std::string>();
    }
    return names;
}

double GltfObject::number_in(const char* key, std::size_t element) const {
    const nlohmann::json& value = list(key)[element];
    if (!value.is_number()) fail_at(key, "has an element that is no number");
    return value.get<double>();
}

std::string GltfObject::text_in(const char* key, std::size_t element) const {
    const nlohmann::json& value = list(key)[element];
    if (!value.is_string()) fail_at(key, "has an element that is no text");
    return value.get<std::string>();
}

void GltfObject::fail(std::string_view problem) const {
    throw_error(ImportStatus::invalid_input, words_, ": ", problem, ". The file is broken; export it again.");
}

void GltfObject::refuse(std::string_view problem) const {
    throw_error(ImportStatus::unsupported, words_, ": ", problem);
}

const nlohmann::json& GltfObject::list(const char* key) const {
    const nlohmann::json& value = json_->at(key);
    if (!value.is_array()) fail_at(key, "is no list");
    return value;
}

void GltfObject::fail_at(const char* key, std::string_view problem) const { fail(text("\"", key, "\" ", problem)); }

}  // namespace espalier::importer
