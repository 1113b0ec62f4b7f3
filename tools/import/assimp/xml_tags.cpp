#include "xml_tags.hpp"

#include <cstddef>

namespace espalier::tools {

namespace {

constexpr std::string_view spaces = " \t\r\n";

bool is_xml_space(char letter) { return spaces.find(letter) != std::string_view::npos; }

}  // namespace

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

}  // namespace espalier::tools
