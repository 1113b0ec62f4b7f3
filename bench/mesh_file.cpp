#include "mesh_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace espalier::bench {
namespace {

[[noreturn]] void fail(const std::string& path, const char* why) {
    std::fprintf(stderr, "%s: %s\n", path.c_str(), why);
    std::exit(2);
}

void read_obj(std::istream& in, Mesh& mesh) {
    std::string line;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Vec3 p;
            words >> p.x >> p.y >> p.z;
            mesh.positions.push_back(p);
        } else if (kind == "f") {
            std::vector<std::uint32_t> face;
            std::string corner;
            while (words >> corner) {
                const long index = std::strtol(corner.c_str(), nullptr, 10);
                const long count = static_cast<long>(mesh.positions.size());
                face.push_back(static_cast<std::uint32_t>(index < 0 ? count + index : index - 1));
            }
            for (std::size_t i = 2; i < face.size(); ++i) mesh.triangles.push_back({face[0], face[i - 1], face[i]});
        }
    }
}

void read_ply(std::istream& in, const std::string& path, Mesh& mesh) {
    std::string line;
    std::size_t vertices = 0, faces = 0, properties = 0;
    bool in_vertex = false;
    while (std::getline(in, line) && line != "end_header") {
        std::sscanf(line.c_str(), "element vertex %zu", &vertices);
        std::sscanf(line.c_str(), "element face %zu", &faces);
        if (line.rfind("element", 0) == 0) in_vertex = line.rfind("element vertex", 0) == 0;
        if (in_vertex && line.rfind("property float", 0) == 0) ++properties;
    }
    if (properties < 3) fail(path, "not a PLY file with float positions");
    std::vector<float> row(properties);
    mesh.positions.resize(vertices);
    for (Vec3& p : mesh.positions) {
        in.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(4 * properties));
        p = {row[0], row[1], row[2]};
    }
    for (std::size_t i = 0; i < faces; ++i) {
        const int corners = in.get();
        std::vector<std::uint32_t> face(corners > 0 ? static_cast<std::size_t>(corners) : 0);
        in.read(reinterpret_cast<char*>(face.data()), static_cast<std::streamsize>(4 * face.size()));
        for (std::size_t c = 2; c < face.size(); ++c) mesh.triangles.push_back({face[0], face[c - 1], face[c]});
    }
    if (!in) fail(path, "ends too early");
}

}  // namespace

Mesh read_mesh(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) fail(path, "cannot be read");
    Mesh mesh;
    mesh.name = path.substr(path.find_last_of('/') + 1);
    if (path.size() > 4 && path.substr(path.size() - 4) == ".ply") read_ply(in, path, mesh);
    else read_obj(in, mesh);
    if (mesh.triangles.empty()) fail(path, "has no triangles");
    return mesh;
}

}  // namespace espalier::bench
