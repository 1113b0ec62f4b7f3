// Every closed model of a folder, as the command reads it, baked with 8, 10, 12 and 16 bits: whether it is called
// closed rightly, and whether `contains` is right. The judge is tests/baker/quantise/closed_check.hpp.
//
// closed_models FOLDER [POINTS_OF_EACH_BAKE]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <espalier/import.hpp>

#include <import/base/placement.hpp>

#include "baker/quantise/closed_check.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::size_t most_triangles = 60'000;
constexpr std::uintmax_t largest_file = 8'000'000;

/// In float32, as the judge takes positions. Nothing when a triangle names a vertex that its mesh does not have.
Mesh joined_meshes(const ImportResult& imported) {
    Mesh all;
    for (const ImportedMesh& mesh : imported.meshes) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const TriangleVertices& triangle : mesh.triangles)
            for (const std::uint32_t vertex : triangle)
                if (vertex >= mesh.positions.size()) return {};
        for (const Vec3d& position : mesh.positions) all.positions.push_back(importer::to_float32(position));
        for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
}

/// Whether each edge, from position to position, runs as often one way as the other.
bool is_watertight(const Mesh& mesh) {
    using Position = std::tuple<float, float, float>;
    std::map<std::pair<Position, Position>, int> edges;
    const auto place = [&](std::uint32_t index) -> Position {
        const Vec3& p = mesh.positions.at(index);
        return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    };
    for (const TriangleVertices& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Position from = place(triangle[k]), to = place(triangle[(k + 1) % 3]);
            if (from < to) ++edges[{from, to}];
            if (to < from) --edges[{to, from}];
        }
    }
    const auto is_finite = [](const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
    return !mesh.triangles.empty() && std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite) &&
           std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.file_size() < largest_file) files.push_back(entry.path().string());
    // They are there to break importers, and do.
    std::erase_if(files, [](const std::string& file) { return file.find("/invalid/") != std::string::npos; });
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count < 2 || !std::filesystem::is_directory(arguments[1])) {
        std::puts("SKIPPED: no folder of models (Debian: assimp-testmodels)");
        return 0;
    }
    const std::uint64_t points = argument_count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 20;
    const unsigned lattices[] = {8, 10, 12, 16};
    std::map<unsigned, ClosedTally> tallies;
    int watertight = 0, wrong = 0;
    Random random(2800);
    for (const std::string& file : files_in(arguments[1])) {
        Mesh mesh;
        const ImportResult imported = import_meshes({&file, 1});
        if (!imported) continue;  // no mesh, or a broken one
        mesh = joined_meshes(imported);
        if (mesh.triangles.size() > most_triangles || !is_watertight(mesh)) continue;
        mesh.name = file;
        ++watertight;
        for (const unsigned bits : lattices) {
            BakeOptions options;
            options.resolution = Resolution::bits(bits);
            options.effort = Effort::fast;
            ClosedTally& tally = tallies[bits];
            const std::uint64_t lost_before = tally.lost;
            const std::string complaint = check_closed(mesh, options, points, random, tally);
            if (tally.lost != lost_before) std::printf("%s at %u bits: lost\n", file.c_str(), bits);
            if (complaint.empty()) continue;
            std::printf("%s at %u bits: %s\n", file.c_str(), bits, complaint.c_str());
            ++wrong;
        }
    }
    std::printf("%d watertight files\n", watertight);
    for (const auto& [bits, tally] : tallies) std::printf("%u bits: %s\n", bits, tally.text().c_str());
    return wrong == 0 && watertight > 0 ? 0 : 1;
}
