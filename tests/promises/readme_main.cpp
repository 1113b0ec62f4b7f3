// Runs the README's examples: bakes a square, casts the example's ray at it and compares what the example prints.
#include <cstddef>
#include <iostream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

std::vector<std::byte> bake_mesh(const std::vector<espalier::Vec3>& positions,
                                 const std::vector<espalier::TriangleVertices>& triangles);
int cast_ray(std::span<const std::byte> bytes);

int main() {
    const std::vector<espalier::Vec3> corners = {{-8, 0, -8}, {8, 0, -8}, {8, 0, 8}, {-8, 0, 8}};
    const std::vector<std::byte> blob = bake_mesh(corners, {{0, 3, 1}, {1, 3, 2}});
    const std::ostringstream printed;
    std::streambuf* const console = std::cout.rdbuf(printed.rdbuf());
    const int status = cast_ray(blob);
    std::cout.rdbuf(console);
    if (status == 0 && printed.str() == "t 10, mesh 0, triangle 1\n") return 0;
    std::cerr << "failed: the README's example returned " << status << " and printed: " << printed.str() << '\n';
    return 1;
}
