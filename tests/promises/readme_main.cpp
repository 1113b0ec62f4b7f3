// Bakes a square with the README's function and writes the blob into the file that is named.
#include <fstream>
#include <vector>

#include <espalier/bake.hpp>

std::vector<std::byte> bake_mesh(const std::vector<espalier::Vec3>& positions,
                                 const std::vector<espalier::TriangleVertices>& triangles);

int main(int count, char** arguments) {
    if (count != 2) return 2;
    const std::vector<espalier::Vec3> corners = {{-8, 0, -8}, {8, 0, -8}, {8, 0, 8}, {-8, 0, 8}};
    const std::vector<std::byte> blob = bake_mesh(corners, {{0, 3, 1}, {1, 3, 2}});
    std::ofstream file(arguments[1], std::ios::binary);
    file.write(reinterpret_cast<const char*>(blob.data()), static_cast<std::streamsize>(blob.size()));
    return file.good() ? 0 : 1;
}
