// A picture made of lines, shapes and words, as SVG 1.1.
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

}  // namespace espalier::tools
