#include <baker/base/number_text.hpp>

#include <cstdio>

namespace espalier::baker {

namespace {

std::string text_of(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

}  // namespace

std::string number_text(double value) { return text_of(value, 9); }

std::string short_number_text(double value) { return text_of(value, 6); }

}  // namespace espalier::baker
