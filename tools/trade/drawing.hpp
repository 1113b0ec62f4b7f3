// A picture made of lines, shapes and words, as SVG 1.1, and pairs of axes in it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::tools {

struct Place {
    double x;
    double y;
};

enum class Anchor { start, middle, end };

struct TextStyle {
    double size = 12.0;
    Anchor anchor = Anchor::start;
    const char* colour = "#222222";
    bool bold = false;
    double turned = 0.0;  ///< degrees
};

enum class Shape { circle, square, triangle, diamond };
inline constexpr std::size_t shape_count = 4;

class Svg {
public:
    Svg(double width, double height);

    void line(Place from, Place to, const char* colour, double width = 1.0);
    void path(const std::vector<Place>& places, const char* colour, double width);
    void rectangle(Place corner, double width, double height, const char* fill, const char* stroke);
    /// `filled` shapes have a white edge, so that they stay distinct where they overlap.
    void shape(Shape shape, Place center, double radius, const char* colour, bool filled);
    void words(Place at, std::string_view written, const TextStyle& style = {});

    /// The whole document.
    [[nodiscard]] std::string str() const;

private:
    std::string body_;
};

/// About how wide the words are in a sans-serif font: for keeping labels apart.
double text_width(std::string_view words, double size);

/// From the least to the largest value, with a margin; made for values above zero.
class AxisRange {
public:
    void include(double value);
    void add_margin(double share);
    [[nodiscard]] double share_of(double value) const;  ///< 0 at the low end, 1 at the high one
    /// About `count` round numbers inside.
    [[nodiscard]] std::vector<double> ticks(unsigned count) const;

private:
    double low_ = 0.0;
    double high_ = 0.0;
    bool is_empty_ = true;
};

class ChartPanel {
public:
    ChartPanel(Place corner, double width, double height, const AxisRange& x, const AxisRange& y)
        : corner_(corner), width_(width), height_(height), x_(x), y_(y) {}

    [[nodiscard]] Place at(double x, double y) const;
    void draw_axes(Svg& svg, const std::string& title, const std::string& x_title, const std::string& y_title) const;
    /// Beside the place, where it covers no earlier label and none of `occupied`; dropped when there is no room.
    void draw_label(Svg& svg, Place place, const std::string& words, const char* colour);
    /// Labels keep away from it.
    void occupy(Place place, double radius);

private:
    struct Box {
        Place low;
        Place high;
    };
    [[nodiscard]] bool is_free(const Box& box) const;

    Place corner_;
    double width_;
    double height_;
    AxisRange x_;
    AxisRange y_;
    std::vector<Box> occupied_;
};

}  // namespace espalier::tools
