// One pair of axes in a picture, and what is drawn into it.
#pragma once

#include <string>
#include <vector>

#include "svg.hpp"

namespace espalier::tools {

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
