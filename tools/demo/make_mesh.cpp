// espalier_demo_mesh FILE.obj: writes the demo's mesh, a trefoil knot above a hilly ground, as OBJ text.
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

struct Point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(double scale, const Point& a) { return {scale * a.x, scale * a.y, scale * a.z}; }
Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Point unit(const Point& a) { return (1.0 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z)) * a; }

void write_vertex(std::FILE* file, const Point& point) {
    std::fprintf(file, "v %.7g %.7g %.7g\n", point.x, point.y, point.z);
}

void write_quad(std::FILE* file, int a, int b, int c, int d) {
    std::fprintf(file, "f %d %d %d\nf %d %d %d\n", a, b, c, a, c, d);
}

Point knot_point(double angle) {
    return {std::sin(angle) + 2.0 * std::sin(2.0 * angle), 3.0 - std::sin(3.0 * angle),
            std::cos(angle) - 2.0 * std::cos(2.0 * angle)};
}

// A closed tube around the knot, ribbed so that its surface has something to show.
int write_knot(std::FILE* file, int first) {
    constexpr int rings = 900;
    constexpr int sides = 32;
    constexpr double full_turn = 2.0 * std::numbers::pi;
    std::fputs("o knot\n", file);
    for (int ring = 0; ring < rings; ++ring) {
        const double angle = full_turn * ring / rings;
        const Point center = knot_point(angle);
        const Point along = unit(knot_point(angle + 1e-3) - knot_point(angle - 1e-3));
        const Point across = unit(cross(along, center - Point{0.0, 3.0, 0.0}));
        const Point outward = cross(across, along);
        for (int side = 0; side < sides; ++side) {
            const double turn = full_turn * side / sides;
            const double radius = 0.5 + 0.03 * std::cos(6.0 * turn + 30.0 * angle);
            write_vertex(file, center + (radius * std::cos(turn)) * outward + (radius * std::sin(turn)) * across);
        }
    }
    for (int ring = 0; ring < rings; ++ring) {
        const int here = first + ring * sides;
        const int next = first + (ring + 1) % rings * sides;
        for (int side = 0; side < sides; ++side) {
            const int other = (side + 1) % sides;
            write_quad(file, here + side, here + other, next + other, next + side);
        }
    }
    return first + rings * sides;
}

int write_ground(std::FILE* file, int first) {
    constexpr int cells = 150;
    constexpr double size = 14.0;
    std::fputs("o ground\n", file);
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const double x = size * (1.0 * column / cells - 0.5);
            const double z = size * (1.0 * row / cells - 0.5);
            const double y = 0.35 * std::sin(1.1 * x) * std::cos(0.9 * z) + 0.06 * std::sin(4.0 * x + 3.0 * z);
            write_vertex(file, {x, y, z});
        }
    }
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const int corner = first + row * (cells + 1) + column;
            write_quad(file, corner, corner + cells + 1, corner + cells + 2, corner + 1);
        }
    }
    return first + (cells + 1) * (cells + 1);
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: espalier_demo_mesh FILE.obj\n", stderr);
        return 1;
    }
    std::FILE* file = std::fopen(arguments[1], "w");
    if (file == nullptr) {
        std::fprintf(stderr, "espalier_demo_mesh: %s cannot be written\n", arguments[1]);
        return 2;
    }
    write_ground(file, write_knot(file, 1));
    return std::fclose(file) == 0 ? 0 : 2;
}
