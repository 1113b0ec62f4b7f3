// A warning about an input or a result: text for people, a kind and a place for scripts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace espalier::tools {

struct Warning {
    std::string kind;     ///< one lower-case word or several joined by '_'; part of the command's interface
    std::string message;  ///< whole sentences: what was found, where, and what to do
    std::string file;     ///< empty for a warning about the whole bake
    std::optional<std::uint32_t> mesh;
    std::optional<std::uint64_t> triangle;
};

}  // namespace espalier::tools
