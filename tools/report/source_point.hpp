// Points of a blob in the coordinates of its source, from which the bake subtracted the origin.
#pragma once

#include <string>

#include <espalier/types.hpp>

#include "json.hpp"

namespace espalier::tools {

/// A point of a blob that is shown in the coordinates of its source. Where the origin is 0 these are the float32
/// numbers of the blob; else each is the shortest decimal that is this float32 number again, once the origin is
/// subtracted.
struct SourcePoint {
    Vec3 in_blob;
    Vec3d origin;
};

struct SourceBox {
    SourcePoint min;
    SourcePoint max;
};

/// A coordinate as it is in a SourcePoint.
std::string words_in_source(float coordinate, double origin);
Json json_in_source(float coordinate, double origin);

/// "x y z"
std::string words_for_point(const SourcePoint& point);
Json json_point(const SourcePoint& point);
Json json_box(const SourceBox& box);

/// "500120 5400320 612", without exponents of ten.
std::string words_for_origin(const Vec3d& origin);

}  // namespace espalier::tools
