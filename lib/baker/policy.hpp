// Whether a bake may lose what it lost.
#pragma once

#include <optional>

#include <espalier/bake.hpp>

#include <baker/base/expected.hpp>

namespace espalier::baker {

/// Returns why a policy refuses a bake with this report.
[[nodiscard]] std::optional<Refusal> judge(const BakePolicy& policy, const BakeReport& report);

}  // namespace espalier::baker
