#include "json_keys.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <deque>
#include <set>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

using Json = nlohmann::json;

/// Keeps the keys of the objects that are open. The parser stops when a function returns false.
class KeyReader final : public nlohmann::json_sax<Json> {
public:
    bool null() override { return next(); }
    bool boolean(bool) override { return next(); }
    bool number_integer(number_integer_t) override { return next(); }
    bool number_unsigned(number_unsigned_t) override { return next(); }
    bool number_float(number_float_t, const string_t&) override { return next(); }
    bool string(string_t&) override { return next(); }
    bool binary(binary_t&) override { return next(); }
    bool start_object(std::size_t) override { return begin(); }
    bool end_object() override { return end(); }
    bool start_array(std::size_t) override { return begin(); }
    bool end_array() override { return end(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

    bool key(string_t& name) override {
        const auto [place, is_new] = open_.back().keys.insert(name);
        if (!is_new) {
            repeated_ = {name, path()};
            return false;
        }
        open_.back().key = &*place;
        return true;
    }

    [[nodiscard]] const std::optional<RepeatedKey>& repeated() const { return repeated_; }

private:
    /// An object, whose last key is `key`, or a list, of which `element` values are read.
    struct Open {
        std::set<std::string> keys = {};
        const std::string* key = nullptr;
        std::uint64_t element = 0;
    };

    bool next() {
        if (!open_.empty()) ++open_.back().element;
        return true;
    }
    bool begin() {
        open_.emplace_back();
        return true;
    }
    bool end() {
        open_.pop_back();
        return next();
    }

    /// Of the innermost object.
    [[nodiscard]] std::string path() const {
        std::string result;
        for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
            const Open& open = open_[i];
            result += open.key == nullptr ? text('[', open.element, ']') : text(i == 0 ? "" : ".", *open.key);
        }
        return result;
    }

    std::deque<Open> open_;  // which keeps the places of keys
    std::optional<RepeatedKey> repeated_;
};

}  // namespace

std::optional<RepeatedKey> repeated_key(std::string_view json) {
    KeyReader reader;
    Json::sax_parse(json, &reader);
    return reader.repeated();
}

}  // namespace espalier::tools
