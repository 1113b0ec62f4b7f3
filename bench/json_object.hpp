// A row of a file of JSON objects, one object a line.
#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

namespace espalier::bench {

inline std::string decimal(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

/// Fields appear in the order in which they were added.
class JsonObject {
public:
    void add(const std::string& name, const std::string& text) {
        std::string quoted = "\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') quoted += '\\';
            if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
        }
        add_raw(name, quoted + "\"");
    }
    void add(const std::string& name, std::size_t value) { add_raw(name, std::to_string(value)); }
    void add(const std::string& name, std::optional<std::size_t> value) {
        add_raw(name, value ? std::to_string(*value) : "null");
    }
    void add(const std::string& name, std::optional<double> value, int digits) {
        add_raw(name, value ? decimal(*value, digits) : "null");
    }
    /// `value` is JSON already.
    void add_raw(const std::string& name, const std::string& value) {
        if (!fields_.empty()) fields_ += ',';
        fields_ += '"' + name + "\":" + value;
    }
    [[nodiscard]] std::string text() const { return '{' + fields_ + '}'; }
    void print() const { std::printf("%s\n", text().c_str()); }

private:
    std::string fields_;
};

}  // namespace espalier::bench
