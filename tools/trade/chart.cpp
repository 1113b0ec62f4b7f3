#include "point.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

#include <import/base/numbers.hpp>

#include "base/choices.hpp"
#include "drawing.hpp"

namespace espalier::tools {

namespace {

constexpr double width = 1240.0;
constexpr double panels_end = 590.0;
constexpr double row_height = 17.0;
constexpr std::size_t most_rows = 30;

/// Okabe and Ito (2008): the colour-blind can distinguish them too. More lattices than colours take them again.
constexpr std::array<const char*, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#B8860B", "#56B4E9", "#222222"};

class TradeChart {
public:
    explicit TradeChart(const std::vector<TradePoint>& points)
        : points_(points), closest_front_(pareto_front(points, timed_queries[0])) {
        for (const TradePoint& point : points) {
            if (std::find(lattices_.begin(), lattices_.end(), point.bits) == lattices_.end()) {
                lattices_.push_back(point.bits);
            }
            has_several_prices_ = has_several_prices_ || point.byte_price != points.front().byte_price;
            has_several_builders_ = has_several_builders_ || point.builder != points.front().builder;
        }
        std::sort(lattices_.begin(), lattices_.end());
    }

    std::string draw(const std::string& mesh, const std::string& conditions) {
        const std::vector<std::size_t> rows = table_rows();
        const std::size_t shown = std::min(rows.size(), most_rows);
        const double table = panels_end + 50.0 + row_height * static_cast<double>(lattices_.size() + 2);
        Svg svg(width, table + row_height * (static_cast<double>(shown) + 5.0));
        svg.words({24.0, 34.0}, text(mesh, ": bytes, time and error"), {.size = 20.0, .bold = true});
        svg.words({24.0, 56.0}, conditions, {.colour = "#555555"});
        draw_panel(svg, 0, {80.0, 100.0}, 690.0, panels_end - 150.0, "closest hit", true);
        draw_panel(svg, 1, {850.0, 100.0}, 360.0, 180.0, "any hit", false);
        draw_panel(svg, 2, {850.0, 360.0}, 360.0, 180.0, "sphere overlap", false);
        draw_legend(svg, panels_end + 34.0);
        draw_table(svg, table, rows, shown);
        return svg.str();
    }

private:
    [[nodiscard]] const char* colour_of(const TradePoint& point) const {
        const auto place = std::find(lattices_.begin(), lattices_.end(), point.bits);
        return colours[static_cast<std::size_t>(place - lattices_.begin()) % colours.size()];
    }
    [[nodiscard]] static Shape shape_of(const TradePoint& point) {
        std::size_t number = 0;
        while (number + 1 < profile_choices.size() && profile_choices[number].second != point.profile) ++number;
        return static_cast<Shape>(number % shape_count);
    }
    [[nodiscard]] std::string label_of(const TradePoint& point) const {
        std::string label = text(point.leaf_size);
        if (has_several_prices_) label += text('/', point.byte_price);
        if (has_several_builders_) label += ' ' + name_in(builder_choices, point.builder);
        return label;
    }

    void draw_panel(Svg& svg, std::size_t query, Place corner, double panel_width, double height,
                    const std::string& title, bool has_labels) const {
        const TimedQuery& timed = timed_queries[query];
        AxisRange x, y;
        for (const TradePoint& point : points_) {
            x.include(point.bytes_per_triangle());
            y.include(point.*timed.nanoseconds);
        }
        x.add_margin(0.06);
        y.add_margin(0.08);
        ChartPanel panel(corner, panel_width, height, x, y);
        panel.draw_axes(svg, title, "bytes a triangle", "nanoseconds a query");
        const auto place_of = [&](const TradePoint& point) {
            return panel.at(point.bytes_per_triangle(), point.*timed.nanoseconds);
        };
        const std::vector<bool> front = pareto_front(points_, timed);
        for (const unsigned bits : lattices_) draw_front(svg, panel, timed, front, bits);
        for (const bool is_front : {false, true}) {  // the front lies on top
            for (std::size_t i = 0; i < points_.size(); ++i) {
                if (front[i] != is_front) continue;
                const double radius = is_front ? 6.0 : 3.5;
                svg.shape(shape_of(points_[i]), place_of(points_[i]), radius, colour_of(points_[i]), is_front);
                panel.occupy(place_of(points_[i]), radius);
            }
        }
        if (!has_labels) return;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (front[i]) panel.draw_label(svg, place_of(points_[i]), label_of(points_[i]), colour_of(points_[i]));
        }
    }

    /// Through the points of one lattice that are on the front, from the smallest to the fastest.
    void draw_front(Svg& svg, const ChartPanel& panel, const TimedQuery& timed, const std::vector<bool>& front,
                    unsigned bits) const {
        std::vector<const TradePoint*> members;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (front[i] && points_[i].bits == bits) members.push_back(&points_[i]);
        }
        if (members.empty()) return;
        std::stable_sort(members.begin(), members.end(),
                         [](const TradePoint* a, const TradePoint* b) { return a->bytes < b->bytes; });
        std::vector<Place> places;
        places.reserve(members.size());
        for (const TradePoint* member : members) {
            places.push_back(panel.at(member->bytes_per_triangle(), member->*timed.nanoseconds));
        }
        svg.path(places, colour_of(*members.front()), 2.0);
    }

    void draw_legend(Svg& svg, double y) const {
        double x = 80.0;
        for (const auto& choice : profile_choices) {
            TradePoint point;
            point.profile = choice.second;
            if (std::none_of(points_.begin(), points_.end(),
                             [&](const TradePoint& other) { return other.profile == choice.second; })) {
                continue;
            }
            svg.shape(shape_of(point), {x, y - 4.0}, 6.0, "#555555", true);
            svg.words({x + 12.0, y}, text("profile ", choice.first));
            x += 130.0;
        }
        x = 80.0;
        y += row_height;
        svg.shape(Shape::circle, {x, y - 4.0}, 3.5, "#555555", false);
        svg.words({x + 12.0, y},
                  text("hollow: another is as good in bytes, time and error, and better in one. Numbers: "
                       "most triangles of a leaf",
                       has_several_prices_ ? " / price of a byte" : "", has_several_builders_ ? ", builder" : "",
                       ". Down and left is better."));
        for (const unsigned bits : lattices_) {
            y += row_height;
            const auto point = std::find_if(points_.begin(), points_.end(),
                                            [&](const TradePoint& other) { return other.bits == bits; });
            svg.line({74.0, y - 4.0}, {100.0, y - 4.0}, colour_of(*point), 3.0);
            svg.words({110.0, y}, text("lattice of ", bits, bits == 1 ? " bit" : " bits", ": error at most ",
                                       rounded(point->max_error, 3), ", on average ", rounded(point->mean_error, 3)));
        }
    }

    /// The front of closest hits, by lattice and then by bytes.
    [[nodiscard]] std::vector<std::size_t> table_rows() const {
        std::vector<std::size_t> rows(points_.size());
        std::iota(rows.begin(), rows.end(), std::size_t{0});
        std::erase_if(rows, [&](std::size_t row) { return !closest_front_[row]; });
        std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
            return points_[a].bits != points_[b].bits ? points_[a].bits < points_[b].bits
                                                      : points_[a].bytes < points_[b].bytes;
        });
        return rows;
    }

    void draw_table(Svg& svg, double y, const std::vector<std::size_t>& rows, std::size_t shown) const {
        svg.words({80.0, y + row_height}, "The front of closest hits", {.size = 13.0, .bold = true});
        y += 2.5 * row_height;
        const auto draw_row = [&](const std::vector<std::string>& cells, const TextStyle& style) {
            double x = 110.0;
            for (const std::string& cell : cells) {
                TextStyle cell_style = style;
                cell_style.anchor = Anchor::end;
                svg.words({x, y}, cell, cell_style);
                x += 90.0;
            }
            y += row_height;
        };
        draw_row({"bits", "profile", "builder", "leaf", "byte price", "bytes", "B/triangle", "closest ns", "any ns",
                  "overlap ns", "nodes/ray", "triangles/ray", "counted cost"},
                 {.size = 11.0, .bold = true});
        for (std::size_t i = 0; i < shown; ++i) {
            const TradePoint& p = points_[rows[i]];
            draw_row({text(p.bits), name_in(profile_choices, p.profile), name_in(builder_choices, p.builder),
                      text(p.leaf_size), text(p.byte_price), text(p.bytes), rounded(p.bytes_per_triangle(), 3),
                      rounded(p.closest_ns, 3), rounded(p.any_ns, 3), rounded(p.overlap_ns, 3),
                      rounded(p.work.nodes, 3), rounded(p.work.triangles, 3), rounded(p.cost, 3)},
                     {.colour = colour_of(p)});
        }
        if (shown < rows.size()) {
            svg.words({80.0, y}, text("and ", rows.size() - shown, " more in the table of numbers"));
        }
    }

    const std::vector<TradePoint>& points_;
    std::vector<bool> closest_front_;
    std::vector<unsigned> lattices_;
    bool has_several_prices_ = false;
    bool has_several_builders_ = false;
};

}  // namespace

std::string trade_chart(const std::string& mesh, const std::string& conditions, const std::vector<TradePoint>& points) {
    return TradeChart(points).draw(mesh, conditions);
}

}  // namespace espalier::tools
