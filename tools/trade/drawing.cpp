#include "drawing.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <import/base/numbers.hpp>

#include "base/exit_code.hpp"
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
        const std::size_t special = std::string_view("&<>\"").find(character);
        if (special != std::string_view::npos) result += std::array{"&amp;", "&lt;", "&gt;", "&quot;"}[special];
        else result += keeps_bytes || static_cast<unsigned char>(character) < 0x80 ? character : '?';
    }
    return result;
}

std::string attribute(const char* name, std::string_view value) { return text(' ', name, "=\"", value, '"'); }
std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

std::string points_of(const std::vector<Place>& places) {
    return listed(places, " ", [](const Place& place) { return text(number(place.x), ',', number(place.y)); });
}

constexpr const char* grid_colour = "#e6e6e6";
constexpr const char* axis_colour = "#888888";
constexpr double label_size = 11.0;

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

void AxisRange::include(double value) {
    low_ = is_empty_ ? value : std::min(low_, value);
    high_ = is_empty_ ? value : std::max(high_, value);
    is_empty_ = false;
}

void AxisRange::add_margin(double share) {
    const double margin = std::max(share * (high_ - low_), 0.01 * std::max(std::abs(high_), 1e-9));
    low_ = std::max(0.0, low_ - margin);
    high_ += margin;
}

double AxisRange::share_of(double value) const { return (value - low_) / (high_ - low_); }

std::vector<double> AxisRange::ticks(unsigned count) const {
    const double wanted = (high_ - low_) / count;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
        if (factor * power >= wanted) step = factor * power;
    }
    std::vector<double> result;
    const double first = std::ceil(low_ / step);
    for (double number = first; number * step <= high_; number += 1.0) result.push_back(number * step);
    return result;
}

Place ChartPanel::at(double x, double y) const {
    return {corner_.x + width_ * x_.share_of(x), corner_.y + height_ * (1.0 - y_.share_of(y))};
}

void ChartPanel::draw_axes(Svg& svg, const std::string& title, const std::string& x_title,
                           const std::string& y_title) const {
    const double bottom = corner_.y + height_;
    for (const double tick : x_.ticks(static_cast<unsigned>(width_ / 80.0))) {
        const double x = corner_.x + width_ * x_.share_of(tick);
        svg.line({x, corner_.y}, {x, bottom}, grid_colour);
        svg.words({x, bottom + 16.0}, rounded(tick, 6), {.size = label_size, .anchor = Anchor::middle});
    }
    for (const double tick : y_.ticks(static_cast<unsigned>(height_ / 50.0))) {
        const double y = corner_.y + height_ * (1.0 - y_.share_of(tick));
        svg.line({corner_.x, y}, {corner_.x + width_, y}, grid_colour);
        svg.words({corner_.x - 6.0, y + 4.0}, rounded(tick, 6), {.size = label_size, .anchor = Anchor::end});
    }
    svg.line({corner_.x, corner_.y}, {corner_.x, bottom}, axis_colour);
    svg.line({corner_.x, bottom}, {corner_.x + width_, bottom}, axis_colour);
    svg.words({corner_.x, corner_.y - 8.0}, title, {.size = 13.0, .bold = true});
    svg.words({corner_.x + width_, bottom + 32.0}, x_title, {.size = label_size, .anchor = Anchor::end});
    svg.words({corner_.x - 42.0, corner_.y}, y_title, {.size = label_size, .anchor = Anchor::end, .turned = -90.0});
}

void ChartPanel::occupy(Place place, double radius) {
    occupied_.push_back({{place.x - radius, place.y - radius}, {place.x + radius, place.y + radius}});
}

bool ChartPanel::is_free(const Box& box) const {
    if (box.low.x < corner_.x || box.high.x > corner_.x + width_ || box.low.y < corner_.y - 4.0 ||
        box.high.y > corner_.y + height_) {
        return false;
    }
    return std::none_of(occupied_.begin(), occupied_.end(), [&](const Box& other) {
        return box.low.x < other.high.x && other.low.x < box.high.x && box.low.y < other.high.y &&
               other.low.y < box.high.y;
    });
}

void ChartPanel::draw_label(Svg& svg, Place place, const std::string& words, const char* colour) {
    const double width = text_width(words, label_size);
    const double half = 0.5 * label_size;
    struct Side {
        double x, y;
        Anchor anchor;
    };
    const Side sides[] = {{9.0, -4.0, Anchor::start},   {9.0, 8.0, Anchor::start},    {-9.0, 8.0, Anchor::end},
                          {-9.0, -4.0, Anchor::end},    {0.0, -14.0, Anchor::middle}, {0.0, 16.0, Anchor::middle},
                          {14.0, -16.0, Anchor::start}, {14.0, 18.0, Anchor::start},  {-14.0, 18.0, Anchor::end},
                          {-14.0, -16.0, Anchor::end}};
    for (const Side& side : sides) {
        const double left = place.x + side.x -
                            (side.anchor == Anchor::end      ? width
                             : side.anchor == Anchor::middle ? 0.5 * width
                                                             : 0.0);
        const double middle = place.y + side.y;
        const Box box = {{left, middle - half}, {left + width, middle + half}};
        if (!is_free(box)) continue;
        occupied_.push_back(box);
        svg.words({place.x + side.x, middle + 0.36 * label_size}, words,
                  {.size = label_size, .anchor = side.anchor, .colour = colour});
        return;
    }
}

}  // namespace espalier::tools
