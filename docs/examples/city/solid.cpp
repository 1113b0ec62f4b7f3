#include "solid.hpp"

namespace city {

void Solid::add_triangle(const Point& a, const Point& b, const Point& c) {
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (const Point& p : {a, b, c}) positions_.push_back({in_metres(p.x), in_metres(p.y), in_metres(p.z)});
    triangles_.push_back({first, first + 1, first + 2});
}

void Solid::add_quad(const Point& a, const Point& b, const Point& c, const Point& d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
}

void Solid::add_box(const Point& l, const Point& h) {
    add_quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
    add_quad({l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z}, {l.x, l.y, l.z});
    add_quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
    add_quad({h.x, h.y, l.z}, {l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z});
    add_quad({h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z});
    add_quad({l.x, h.y, l.z}, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z});
}

void Solid::add_roof(const Point& l, const Point& h) {
    const int ridge = (l.x + h.x) / 2;
    const Point front = {ridge, l.y, h.z}, back = {ridge, h.y, h.z};
    add_quad({h.x, l.y, l.z}, {h.x, h.y, l.z}, back, front);
    add_quad({l.x, h.y, l.z}, {l.x, l.y, l.z}, front, back);
    add_triangle({l.x, l.y, l.z}, {h.x, l.y, l.z}, front);
    add_triangle({h.x, h.y, l.z}, {l.x, h.y, l.z}, back);
    add_quad({l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z}, {l.x, l.y, l.z});
}

void Solid::add_rings(int bottom, int ring_height, const std::vector<int>& radii) {
    // Corners of an octagon, in twelfths of its radius.
    constexpr int corner[8][2] = {{12, 5}, {5, 12}, {-5, 12}, {-12, 5}, {-12, -5}, {-5, -12}, {5, -12}, {12, -5}};
    const auto at = [&](std::size_t ring, int side) -> Point {
        const int(&c)[2] = corner[side % 8];
        return {radii[ring] * c[0] / 12, radii[ring] * c[1] / 12, bottom + static_cast<int>(ring) * ring_height};
    };
    const std::size_t top = radii.size() - 1;
    for (std::size_t ring = 0; ring < top; ++ring)
        for (int side = 0; side < 8; ++side)
            add_quad(at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side));
    for (int side = 1; side < 7; ++side) {
        add_triangle(at(0, 0), at(0, side + 1), at(0, side));
        add_triangle(at(top, 0), at(top, side), at(top, side + 1));
    }
}

}  // namespace city
