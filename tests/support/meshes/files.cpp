#include "files.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace espalier::tests {

namespace {

std::filesystem::path folder() {
    const char* chosen = std::getenv("ESPALIER_MESHES");
    return chosen != nullptr ? chosen : ESPALIER_MESHES_DEFAULT;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* why) {
    throw std::runtime_error(file.string() + ": " + why);
}

/// "7", "7/1" or "7//3", counted from 1, or from the end when negative.
std::uint32_t obj_index(const std::string& word, std::size_t count, const std::filesystem::path& file) {
    const long number = std::strtol(word.c_str(), nullptr, 10);
    const long index = number < 0 ? static_cast<long>(count) + number : number - 1;
    if (number == 0 || index < 0 || static_cast<std::size_t>(index) >= count) refuse(file, "a face names no vertex");
    return static_cast<std::uint32_t>(index);
}

Mesh read_obj(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) refuse(file, "cannot be read");
    Mesh mesh;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Vec3 p;
            words >> p.x >> p.y >> p.z;
            mesh.positions.push_back(p);
        } else if (kind == "f") {
            std::vector<std::uint32_t> corners;
            for (std::string word; words >> word;) corners.push_back(obj_index(word, mesh.positions.size(), file));
            for (std::size_t i = 2; i < corners.size(); ++i) {
                mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
            }
        }
    }
    return mesh;
}

template <class Number>
Number read_number(std::istream& in) {
    static_assert(std::endian::native == std::endian::little, "read_ply copies little-endian numbers");
    char bytes[sizeof(Number)];
    in.read(bytes, sizeof bytes);
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
}

Mesh read_ply(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string header;
    std::size_t vertices = 0, faces = 0;
    for (std::string line; std::getline(in, line) && line != "end_header";) {
        header += line + "\n";
        std::istringstream words(line);
        std::string keyword;
        std::string element;
        words >> keyword >> element;
        if (keyword == "element" && element == "vertex") words >> vertices;
        if (keyword == "element" && element == "face") words >> faces;
    }
    if (header.find("binary_little_endian") == std::string::npos ||
        header.find("list uchar int vertex_indices") == std::string::npos) {
        refuse(file, "is no PLY of the one kind that the tests read");
    }
    Mesh mesh;
    mesh.positions.resize(vertices);
    for (Vec3& p : mesh.positions) {
        p.x = read_number<float>(in);
        p.y = read_number<float>(in);
        p.z = read_number<float>(in);
    }
    mesh.triangles.resize(faces);
    for (TriangleVertices& corners : mesh.triangles) {
        if (read_number<std::uint8_t>(in) != 3) refuse(file, "has a face that is no triangle");
        for (std::uint32_t& corner : corners) corner = read_number<std::uint32_t>(in);
    }
    if (!in) refuse(file, "ends early");
    return mesh;
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
    Mesh mesh = file.extension() == ".ply" ? read_ply(file) : read_obj(file);
    mesh.name = file.filename().string();
    return mesh;
}

std::vector<std::filesystem::path> mesh_files() {
    std::vector<std::filesystem::path> files;
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(folder(), absent)) {
        const auto ending = entry.path().extension();
        if (ending == ".obj" || ending == ".ply") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::optional<std::filesystem::path> mesh_file(const char* name) {
    const std::filesystem::path file = folder() / name;
    std::error_code absent;
    if (!std::filesystem::is_regular_file(file, absent)) return std::nullopt;
    return file;
}

}  // namespace espalier::tests
