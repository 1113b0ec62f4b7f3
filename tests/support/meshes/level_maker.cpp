#include "level_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "support/base/random.hpp"

namespace espalier::tests {
namespace {

constexpr int columns = 30;
constexpr int rows = 22;

/// What is above one cell of the plan.
struct Cell {
    bool is_open = false;
    bool is_outside = false;  // no ceiling, uneven ground
    float floor = 0.0f, ceiling = 0.0f;
};

struct Room {
    int column = 0, row = 0, width = 0, depth = 0;
    float floor = 0.0f;
    [[nodiscard]] int middle_column() const { return column + width / 2; }
    [[nodiscard]] int middle_row() const { return row + depth / 2; }
};

class LevelMaker {
public:
    explicit LevelMaker(std::uint64_t seed) : random_(seed), cells_(columns * rows) {}

    Mesh make(unsigned least_triangles) {
        draw_lines(x_lines_);
        draw_lines(y_lines_);
        draw_plan();
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) build_cell(column, row);
        for (const Room& room : rooms_) build_pillars(room);
        while (mesh_.triangles.size() < least_triangles) {
            const Room& room = rooms_[random_.below(static_cast<std::uint32_t>(rooms_.size()))];
            if (random_.below(3) == 0) build_barrel(room);
            else build_crate(room);
        }
        mesh_.name = "level";
        return std::move(mesh_);
    }

private:
    Cell& cell(int column, int row) { return cells_[static_cast<std::size_t>(row * columns + column)]; }
    [[nodiscard]] bool is_open(int column, int row) {
        return column >= 0 && row >= 0 && column < columns && row < rows && cell(column, row).is_open;
    }

    template <std::size_t count>
    void draw_lines(std::array<float, count>& lines) {
        for (std::size_t i = 1; i < count; ++i)
            lines[i] = lines[i - 1] + 1.0f + 0.01f * static_cast<float>(random_.below(80));
    }

    // ---- the plan

    void draw_plan() {
        const Room courtyard = {2, 2, 9, 8, -0.3f};
        carve_room(courtyard, 0.0f, true);
        for (int attempt = 0; attempt < 200 && rooms_.size() < 11; ++attempt) {
            Room room;
            room.width = random_.between(3, 7);
            room.depth = random_.between(3, 6);
            room.column = random_.between(1, columns - room.width - 1);
            room.row = random_.between(1, rows - room.depth - 1);
            room.floor = 0.17f * static_cast<float>(random_.between(-4, 8));
            if (is_free(room)) carve_room(room, 2.5f + 0.05f * static_cast<float>(random_.below(40)), false);
        }
        for (std::size_t i = 1; i < rooms_.size(); ++i) carve_corridor(rooms_[i - 1], rooms_[i]);
    }

    bool is_free(const Room& room) {
        for (int row = room.row - 1; row <= room.row + room.depth; ++row)
            for (int column = room.column - 1; column <= room.column + room.width; ++column)
                if (is_open(column, row)) return false;
        return true;
    }

    void carve_room(const Room& room, float height, bool is_outside) {
        for (int row = room.row; row < room.row + room.depth; ++row)
            for (int column = room.column; column < room.column + room.width; ++column)
                cell(column, row) = {true, is_outside, room.floor, is_outside ? 5.0f : room.floor + height};
        rooms_.push_back(room);
    }

    /// Along one axis, then along the other, in steps from floor to floor; what is open already stays.
    void carve_corridor(const Room& from, const Room& to) {
        int column = from.middle_column();
        int row = from.middle_row();
        const int length = std::abs(to.middle_column() - column) + std::abs(to.middle_row() - row);
        for (int step = 1; step <= length; ++step) {
            if (column != to.middle_column()) column += column < to.middle_column() ? 1 : -1;
            else row += row < to.middle_row() ? 1 : -1;
            const float way = static_cast<float>(step) / static_cast<float>(length);
            const float floor = from.floor + std::round((to.floor - from.floor) * way / 0.17f) * 0.17f;
            if (!is_open(column, row)) cell(column, row) = {true, false, floor, floor + 2.2f};
        }
    }

    // ---- floors, ceilings and walls

    std::uint32_t add_point(float x, float y, float z) {
        mesh_.positions.push_back({x, y, z});
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }
    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh_.triangles.push_back({a, b, c});
        mesh_.triangles.push_back({a, c, d});
    }

    void build_cell(int column, int row) {
        const Cell here = cell(column, row);
        if (!here.is_open) return;
        const float x[2] = {x_lines_[static_cast<std::size_t>(column)], x_lines_[static_cast<std::size_t>(column) + 1]};
        const float y[2] = {y_lines_[static_cast<std::size_t>(row)], y_lines_[static_cast<std::size_t>(row) + 1]};
        if (here.is_outside) build_ground(x, y, here.floor);
        else build_slab(x, y, here.floor, true);
        if (!here.is_outside) build_slab(x, y, here.ceiling, false);
        build_walls(here, column - 1, row, {x[0], y[1]}, {x[0], y[0]});
        build_walls(here, column + 1, row, {x[1], y[0]}, {x[1], y[1]});
        build_walls(here, column, row - 1, {x[0], y[0]}, {x[1], y[0]});
        build_walls(here, column, row + 1, {x[1], y[1]}, {x[0], y[1]});
    }

    void build_slab(const float (&x)[2], const float (&y)[2], float z, bool faces_up) {
        const std::uint32_t a = add_point(x[0], y[0], z);
        const std::uint32_t b = add_point(x[1], y[0], z);
        const std::uint32_t c = add_point(x[1], y[1], z);
        const std::uint32_t d = add_point(x[0], y[1], z);
        if (faces_up) add_quad(a, b, c, d);
        else add_quad(d, c, b, a);
    }

    /// Three by three, level along the border of the cell.
    void build_ground(const float (&x)[2], const float (&y)[2], float z) {
        std::uint32_t points[4][4];
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const bool is_inside = i % 3 != 0 && j % 3 != 0;
                const float bump = is_inside ? 0.12f * random_.signed_unit() : 0.0f;
                const float along[2] = {static_cast<float>(i) / 3.0f, static_cast<float>(j) / 3.0f};
                points[j][i] = add_point(x[0] + (x[1] - x[0]) * along[0], y[0] + (y[1] - y[0]) * along[1], z + bump);
            }
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i)
                add_quad(points[j][i], points[j][i + 1], points[j + 1][i + 1], points[j + 1][i]);
    }

    struct PlanPoint {
        float x = 0.0f, y = 0.0f;
    };
    void build_wall(const PlanPoint& from, const PlanPoint& to, float low, float high) {
        if (!(low < high)) return;
        add_quad(add_point(from.x, from.y, low), add_point(to.x, to.y, low), add_point(to.x, to.y, high),
                 add_point(from.x, from.y, high));
    }

    /// What of the neighbour stands in the way: all of it, a step below, a lintel above.
    void build_walls(const Cell& here, int column, int row, const PlanPoint& from, const PlanPoint& to) {
        if (!is_open(column, row)) {
            build_wall(from, to, here.floor, here.ceiling);
            return;
        }
        const Cell& there = cell(column, row);
        build_wall(from, to, here.floor, std::min(there.floor, here.ceiling));
        build_wall(from, to, std::max(there.ceiling, here.floor), here.ceiling);
    }

    // ---- what stands in the rooms

    /// Sides and, if it has one, a lid of a prism; the bottom is on the floor or in it.
    void build_prism(const PlanPoint& center, float radius, unsigned sides, float turned, float low, float high,
                     bool has_lid) {
        std::vector<std::uint32_t> bottom;
        std::vector<std::uint32_t> top;
        for (unsigned i = 0; i < sides; ++i) {
            const float angle = turned + 6.2831853f * static_cast<float>(i) / static_cast<float>(sides);
            const float x = center.x + radius * std::cos(angle);
            const float y = center.y + radius * std::sin(angle);
            bottom.push_back(add_point(x, y, low));
            top.push_back(add_point(x, y, high));
        }
        for (unsigned i = 0; i < sides; ++i) add_quad(bottom[i], bottom[(i + 1) % sides], top[(i + 1) % sides], top[i]);
        for (unsigned i = 2; has_lid && i < sides; ++i) mesh_.triangles.push_back({top[0], top[i - 1], top[i]});
    }

    PlanPoint somewhere_in(const Room& room) {
        const float low_x = x_lines_[static_cast<std::size_t>(room.column)];
        const float low_y = y_lines_[static_cast<std::size_t>(room.row)];
        const float x = x_lines_[static_cast<std::size_t>(room.column + room.width)] - low_x;
        const float y = y_lines_[static_cast<std::size_t>(room.row + room.depth)] - low_y;
        const float along = 0.1f + 0.8f * random_.unit();
        return {low_x + x * along, low_y + y * (0.1f + 0.8f * random_.unit())};
    }

    void build_pillars(const Room& room) {
        const Cell& inside = cell(room.column, room.row);
        for (int row = room.row + 1; row < room.row + room.depth; row += 2)
            for (int column = room.column + 1; column < room.column + room.width; column += 2)
                build_prism({x_lines_[static_cast<std::size_t>(column)], y_lines_[static_cast<std::size_t>(row)]},
                            0.22f, 8, 0.39f, room.floor, inside.is_outside ? room.floor + 2.4f : inside.ceiling,
                            inside.is_outside);
    }
    void build_barrel(const Room& room) {
        build_prism(somewhere_in(room), 0.3f, 12, random_.unit(), room.floor, room.floor + 0.9f, true);
    }
    void build_crate(const Room& room) {
        const float half = 0.3f + 0.3f * random_.unit();
        build_prism(somewhere_in(room), half * 1.414f, 4, 3.0f * random_.unit(), room.floor, room.floor + half * 1.8f,
                    true);
    }

    Random random_;
    Mesh mesh_;
    std::vector<Cell> cells_;
    std::vector<Room> rooms_;
    std::array<float, columns + 1> x_lines_{};
    std::array<float, rows + 1> y_lines_{};
};

}  // namespace

Mesh make_level(unsigned least_triangles, std::uint64_t seed) { return LevelMaker(seed).make(least_triangles); }

}  // namespace espalier::tests
