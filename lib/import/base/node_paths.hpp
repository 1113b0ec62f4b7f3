// The names of the nodes that lead to a mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <import/base/text_file.hpp>

namespace espalier::importer {

/// The names of the nodes that lead from the top of a scene to a node, joined by '/', as "Walls/Door_02". Nodes without
/// a name are left out.
class NodePaths {
public:
    static constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();

    /// Adds a node below one that was added, or below none, and returns its number here.
    std::uint32_t add(std::uint32_t parent, std::string_view name) {
        if (name.empty()) return parent;
        constexpr std::size_t longest_end = longest_path + 4;  // by a character more than the longest path
        nodes_.push_back({parent, end_of(utf8_name(name), longest_end)});
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    /// Returns the path, and only the last 1,000 bytes of a longer one, behind "...": the paths of nodes that are
    /// nested as deep as a file likes would fill the memory.
    [[nodiscard]] std::string path_of(std::uint32_t node) const {
        std::string path;
        for (; node != no_node && path.size() <= longest_path; node = nodes_[node].parent)
            path.insert(0, path.empty() ? nodes_[node].name : nodes_[node].name + '/');
        if (path.size() <= longest_path) return path;
        return std::string("...").append(end_of(path, longest_path));
    }

private:
    struct NamedNode {
        std::uint32_t parent;
        std::string name;
    };
    static constexpr std::size_t longest_path = 1000;

    /// Returns the last characters of a text in UTF-8: all, or so many that they have at most this many bytes.
    static std::string end_of(const std::string& text, std::size_t most) {
        std::size_t begin = text.size() - std::min(text.size(), most);
        while (begin > 0 && begin < text.size() && (static_cast<unsigned char>(text[begin]) & 0xC0) == 0x80) ++begin;
        return text.substr(begin);
    }

    std::vector<NamedNode> nodes_;
};

}  // namespace espalier::importer
