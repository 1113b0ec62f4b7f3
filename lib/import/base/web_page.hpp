// Web pages: what a browser or a script saves when a link leads to a page about a file, not to the file.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include <import/base/numbers.hpp>

namespace espalier::importer {

/// Tests whether a text begins as HTML does, after a byte order mark, spaces and a declaration of XML.
inline bool is_web_page(std::string_view begin) {
    constexpr std::size_t longest_mark = 14;
    const auto skip_spaces = [&begin] {
        begin.remove_prefix(std::min(begin.find_first_not_of(" \t\r\n"), begin.size()));
    };
    if (begin.starts_with("\xEF\xBB\xBF")) begin.remove_prefix(3);
    skip_spaces();
    if (begin.starts_with("<?xml")) {
        begin.remove_prefix(std::min(begin.find('>'), begin.size() - 1) + 1);
        skip_spaces();
    }
    const std::string mark = lower_case(begin.substr(0, longest_mark));
    return mark == "<!doctype html" || mark.starts_with("<html");
}

inline std::string words_for_web_page(const std::string& path) {
    return text('\'', printable(path),
                "' is a web page (HTML) in the place of the file: the link of the download led to a page. Download the "
                "file itself.");
}

}  // namespace espalier::importer
