#include "importer_reports.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace espalier::tools {

namespace {

// In lower case. assimp has no other way to state that it left something out.
constexpr std::string_view losses[] = {
    "triangulate polygon", "unknown polygon",  "zero indices",     "invalid index",
    "vertex index",        "vertex reference", "face index",       "face record",
    "number of faces",     "number of verts",  "face count",       "vertex count",
    "not enough vertices", "vertex setup",     "indices per face", "mesh group",
    "find geometry",       "openings",         "window caps",
};
constexpr std::string_view looks[] = {"color", "material", "normal", "texture", "tvertex", "uv"};

template <std::size_t count>
bool contains_any(std::string_view line, const std::string_view (&words)[count]) {
    return std::any_of(std::begin(words), std::end(words),
                       [line](std::string_view word) { return line.find(word) != std::string_view::npos; });
}

}  // namespace

bool reports_lost_geometry(std::string_view line) {
    std::string lower(line);
    for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return contains_any(lower, losses) && !contains_any(lower, looks);
}

}  // namespace espalier::tools
