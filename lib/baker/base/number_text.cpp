#include <baker/base/number_text.hpp>

#include <cstdio>

namespace espalier::baker {

std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace espalier::baker
