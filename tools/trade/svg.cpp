#include "svg.hpp"

#include <array>
#include <charconv>

#include "base/numbers.hpp"
#include "report/json.hpp"

namespace espalier::tools {

namespace {

std::string number(double value) {
    std::array<char, 64> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 2);
    return {buffer.data(), end.ptr};
}

/// Names come out of files: whatever XML cannot hold is replaced.
std::string escaped_for_xml(std::string_view words) {
    const std::string clean = printable(words);
    const bool keeps_bytes = is_utf8(clean);
    std::string result;
    for (const char character : clean) {
        switch (character) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += keeps_bytes || static_cast<unsigned char>(character) < 0x80 ? character : '?';
        }
    }
    return result;
}

std::string attribute(const char* name, std::string_view value) { return text(' ', name, "=\"", value, '"'); }
std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

std::string points_of(const std::vector<Place>& places) {
    std::string result;
    for (const Place& place : places) {
        result += text(result.empty() ? "" : " ", number(place.x), ',', number(place.y));
    }
    return result;
}

}  // namespace

Svg::Svg(double width, double height)
    : body_(
          text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"",
               attribute("width", width), attribute("height", height),
               attribute("viewBox", text("0 0 ", number(width), ' ', number(height))),
               " font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n")) {
    rectangle({0.0, 0.0}, width, height, "#ffffff", "none");
}

void Svg::line(Place from, Place to, const char* colour, double width) {
    body_ += text("<line", attribute("x1", from.x), attribute("y1", from.y), attribute("x2", to.x),
                  attribute("y2", to.y), attribute("stroke", colour), attribute("stroke-width", width), "/>\n");
}

void Svg::path(const std::vector<Place>& places, const char* colour, double width) {
    body_ += text("<polyline", attribute("points", points_of(places)), attribute("stroke", colour),
                  attribute("stroke-width", width), " stroke-linejoin=\"round\" fill=\"none\"/>\n");
}

void Svg::rectangle(Place corner, double width, double height, const char* fill, const char* stroke) {
    body_ += text("<rect", attribute("x", corner.x), attribute("y", corner.y), attribute("width", width),
                  attribute("height", height), attribute("fill", fill), attribute("stroke", stroke), "/>\n");
}

void Svg::shape(Shape shape, Place center, double radius, const char* colour, bool filled) {
    const std::string look = text(attribute("fill", filled ? colour : "none"),
                                  attribute("stroke", filled ? "#ffffff" : colour), attribute("stroke-width", 1.0));
    if (shape == Shape::circle) {
        body_ +=
            text("<circle", attribute("cx", center.x), attribute("cy", center.y), attribute("r", radius), look, "/>\n");
        return;
    }
    const auto [x, y] = center;
    const double r = 0.9 * radius;
    const double long_r = 1.25 * radius;
    const std::vector<Place> corners =
        shape == Shape::square ? std::vector<Place>{{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}}
        : shape == Shape::triangle
            ? std::vector<Place>{{x, y - long_r},
                                 {x + 1.1 * radius, y + 0.7 * radius},
                                 {x - 1.1 * radius, y + 0.7 * radius}}
            : std::vector<Place>{{x, y - long_r}, {x + long_r, y}, {x, y + long_r}, {x - long_r, y}};
    body_ += text("<polygon", attribute("points", points_of(corners)), look, "/>\n");
}

void Svg::words(Place at, std::string_view written, const TextStyle& style) {
    constexpr const char* anchors[] = {"start", "middle", "end"};
    body_ += text("<text", attribute("x", at.x), attribute("y", at.y), attribute("font-size", style.size),
                  attribute("text-anchor", anchors[static_cast<unsigned>(style.anchor)]),
                  attribute("fill", style.colour), style.bold ? " font-weight=\"bold\"" : "");
    if (style.turned != 0.0) {
        body_ +=
            attribute("transform", text("rotate(", number(style.turned), ' ', number(at.x), ' ', number(at.y), ')'));
    }
    body_ += text('>', escaped_for_xml(written), "</text>\n");
}

std::string Svg::str() const { return body_ + "</svg>\n"; }

double text_width(std::string_view words, double size) { return 0.6 * size * static_cast<double>(words.size()); }

}  // namespace espalier::tools
