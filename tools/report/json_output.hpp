// The --json side of every verb: one object on stdout, keys in a fixed order, "schema" first.
#pragma once

#include <string>

#include <espalier/types.hpp>

#include "json.hpp"

namespace espalier::tools {

/// Raised when a key is taken away or changes its meaning; keys may be added without.
inline constexpr int json_schema = 1;

/// An object that starts with the schema.
Json json_document();
/// A float as the shortest decimal that reads back as the same float; null for what JSON cannot say (inf, nan).
Json json_number(float value);
Json json_point(Vec3 value);
Json json_box(Vec3 min, Vec3 max);
/// Returns the document as it is printed, with a line's end.
std::string json_text(const Json& document);
/// To stdout, and checks that it got there.
void print_json(const Json& document);

}  // namespace espalier::tools
