#include "diagnostics.hpp"

#include <optional>

#include "console.hpp"

namespace espalier::tools {

namespace {

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

}  // namespace

void give(std::span<const Warning> found, std::vector<Warning>& warnings) {
    for (const Warning& warning : found) Console::warn(warning);
    warnings.insert(warnings.end(), found.begin(), found.end());
}

Json diagnostic_json(const Warning& warning) {
    return {{"kind", warning.kind},
            {"message", warning.message},
            {"file", warning.file.empty() ? Json(nullptr) : Json(warning.file)},
            {"mesh", or_null(warning.mesh)},
            {"triangle", or_null(warning.triangle)}};
}

Json warnings_json(std::span<const Warning> warnings) {
    Json list = Json::array();
    for (const Warning& warning : warnings) list.push_back(diagnostic_json(warning));
    return list;
}

}  // namespace espalier::tools
