// Why a bake from C has no blob.
#pragma once

#include <optional>
#include <string>

#include <espalier/bake.hpp>
#include <espalier/c/bake.h>

namespace espalier::baker {

struct Failure {
    espalier_bake_status status = ESPALIER_BAKE_INTERNAL;
    std::string message;
    std::optional<SourcePlace> place = std::nullopt;
};

}  // namespace espalier::baker
