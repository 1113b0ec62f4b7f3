#include "strip_shapes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "makers.hpp"

namespace espalier::tests {

namespace {

Vec3 on_circle(unsigned place, unsigned places, double radius, double z) {
    const double angle = 2.0 * std::numbers::pi * place / places;
    return {static_cast<float>(128.0 + radius * std::cos(angle)), static_cast<float>(128.0 + radius * std::sin(angle)),
            static_cast<float>(z)};
}

/// A grid of triangles, each followed by the same one wound the other way.
Mesh make_double_sided(unsigned side) {
    Mesh mesh = {.name = "double-sided grid"};
    for (unsigned row = 0; row <= side; ++row) {
        for (unsigned column = 0; column <= side; ++column) {
            mesh.positions.push_back({static_cast<float>(20 * column), static_cast<float>(20 * row),
                                      static_cast<float>(3 * ((row * column) % 5))});
        }
    }
    for (unsigned row = 0; row < side; ++row) {
        for (unsigned column = 0; column < side; ++column) {
            const std::uint32_t a = row * (side + 1) + column, b = a + 1, c = a + side + 2, d = a + side + 1;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {c, b, a}, {a, c, d}, {d, c, a}});
        }
    }
    return mesh;
}

/// Triangles that all share one edge, every third one wound the other way.
Mesh make_book(unsigned pages) {
    Mesh mesh = {.name = "book", .positions = {{128, 128, 0}, {128, 128, 100}}};
    for (unsigned page = 0; page < pages; ++page) {
        mesh.positions.push_back(on_circle(page, pages, 90.0, 40.0 + page));
        const std::uint32_t corner = page + 2;
        if (page % 3 == 0) mesh.triangles.push_back({1, 0, corner});
        else mesh.triangles.push_back({0, 1, corner});
    }
    return mesh;
}

/// All triangles over a few vertices, in one winding or both.
Mesh make_complete(unsigned vertices, bool both) {
    Mesh mesh = {.name = both ? "all triangles over few vertices, both ways" : "all triangles over few vertices"};
    for (unsigned i = 0; i < vertices; ++i) mesh.positions.push_back(on_circle(i, vertices, 100.0, 7.0 * (i * i % 11)));
    for (std::uint32_t a = 0; a < vertices; ++a) {
        for (std::uint32_t b = a + 1; b < vertices; ++b) {
            for (std::uint32_t c = b + 1; c < vertices; ++c) {
                mesh.triangles.push_back({b, c, a});
                if (both) mesh.triangles.push_back({c, b, a});
            }
        }
    }
    return mesh;
}

/// Closed tetrahedra far apart.
Mesh make_tetrahedra(unsigned count) {
    Mesh mesh = {.name = "tetrahedra"};
    for (unsigned i = 0; i < count; ++i) {
        const auto x = static_cast<float>(25 * i);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 10, 0, 0}, {x, 10, 0}, {x, 0, 10}});
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            mesh.triangles.push_back({first + a, first + b, first + c});
        };
        add(0, 2, 1), add(0, 1, 3), add(0, 3, 2), add(1, 2, 3);
    }
    return mesh;
}

}  // namespace

Mesh make_fan(unsigned count, bool closed) {
    Mesh mesh = {.name = closed ? "closed fan" : "fan"};
    mesh.positions.push_back({128, 128, 50});
    const unsigned rim = closed ? count : count + 1;
    for (unsigned i = 0; i < rim; ++i) mesh.positions.push_back(on_circle(i, count + 3, 100.0, i % 7));
    for (unsigned i = 0; i < count; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % rim});
    return mesh;
}

Mesh make_band(unsigned count, bool twisted) {
    Mesh mesh = {.name = twisted ? "Moebius band" : "band"};
    const unsigned places = count / 2;
    for (unsigned i = 0; i < places; ++i) {
        const double turn = twisted ? std::numbers::pi * i / places : 0.0;
        mesh.positions.push_back(on_circle(i, places, 90.0 + 20.0 * std::cos(turn), 50.0 + 20.0 * std::sin(turn)));
        mesh.positions.push_back(on_circle(i, places, 90.0 - 20.0 * std::cos(turn), 50.0 - 20.0 * std::sin(turn)));
    }
    for (std::uint32_t i = 0; i < places; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1;
        std::uint32_t c = (a + 2) % (2 * places), d = c + 1;
        if (twisted && i + 1 == places) std::swap(c, d);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {c, b, d}});
    }
    return mesh;
}

Mesh make_disjoint(unsigned count) {
    Mesh mesh = {.name = "disjoint triangles"};
    for (unsigned i = 0; i < count; ++i) {
        const auto at = static_cast<float>(10 * i);
        append_triangle(mesh, {at, 0, 0}, {at + 5, 7, at}, {at, 9, 3});
    }
    return mesh;
}

std::vector<Mesh> strip_shapes() {
    return {make_fan(50, false),    make_fan(50, true),      make_fan(30, false),    make_band(50, false),
            make_band(50, true),    make_disjoint(18),       make_disjoint(40),      make_double_sided(3),
            make_double_sided(5),   make_book(16),           make_book(3),           make_complete(4, false),
            make_complete(4, true), make_complete(6, false), make_complete(6, true), make_tetrahedra(1),
            make_tetrahedra(13)};
}

}  // namespace espalier::tests
