#include "json_output.hpp"

#include <cmath>
#include <iostream>

#include "base/numbers.hpp"
#include "console.hpp"

namespace espalier::tools {

Json json_document() { return Json{{"schema", json_schema}}; }

Json json_number(float value) {
    if (!std::isfinite(value)) return nullptr;
    return *parse_double(shortest(value));
}

Json json_point(Vec3 value) { return Json::array({json_number(value.x), json_number(value.y), json_number(value.z)}); }

Json json_box(Vec3 min, Vec3 max) { return {{"min", json_point(min)}, {"max", json_point(max)}}; }

std::string json_text(const Json& document) { return document.dump() + '\n'; }

void print_json(const Json& document) {
    std::cout << json_text(document);
    finish_standard_output();
}

}  // namespace espalier::tools
