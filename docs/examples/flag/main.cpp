// flag [FOLDER]: rain falls on a flag in the wind: 512 steps of 1/64 s. With FOLDER writes four scenes
// there, which `espalier render` draws.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth.hpp"
#include "collider.hpp"
#include "frame.hpp"
#include "rain.hpp"

namespace {

using namespace flag;

constexpr std::uint32_t drop_count = 240;
constexpr std::uint32_t steps_of_line = 64;
constexpr std::uint32_t line_count = 8;
constexpr std::uint32_t frame_steps[] = {256, 320, 352, 384};

void write_file(const std::string& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.good()) throw std::runtime_error("cannot write " + path);
}

/// Returns the poses that the tree is made for: some moments of a gust.
std::vector<std::vector<espalier::Vec3>> sample_poses() {
    std::vector<std::vector<espalier::Vec3>> poses;
    for (std::uint32_t step = 16; step < 256; step += 48) move_cloth(step, poses.emplace_back());
    return poses;
}

void run(const char* folder) {
    std::vector<espalier::Vec3> positions;
    move_cloth(0, positions);
    const std::vector<espalier::TriangleVertices> triangles = cloth_triangles();
    Collider collider(positions, triangles, sample_poses());
    Rain rain(drop_count);
    std::printf("flag     %zu triangles: %zu bytes move, %zu stay\n", triangles.size(), collider.moving_bytes(),
                collider.resting_bytes());

    Counts counts;
    float worst = 0.0f;
    unsigned frame = 0;
    for (std::uint32_t step = 1; step <= line_count * steps_of_line; ++step) {
        // 1. The cloth moves, 2. its tree follows, 3. the rain meets it in its new pose.
        move_cloth(step, positions);
        const float quality = collider.move(positions);
        rain.fall(collider.blob(), counts);

        worst = quality > worst ? quality : worst;
        if (folder != nullptr && frame < std::size(frame_steps) && step == frame_steps[frame])
            write_file(std::string(folder) + "/flag_" + std::to_string(++frame) + ".esps",
                       make_frame(collider.seal(), rain.drops()));
        if (step % steps_of_line != 0) continue;
        std::printf("step %3u hits %u, pushes %u, landed %u; quality at worst %.2f\n", step, counts.hits, counts.pushes,
                    counts.landed, static_cast<double>(worst));
        counts = {};
        worst = 0.0f;
    }
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count > 2) {
        std::fputs("usage: flag [FOLDER]\n", stderr);
        return 1;
    }
    try {
        run(argument_count == 2 ? arguments[1] : nullptr);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "flag: %s\n", problem.what());
        return 3;
    }
    return 0;
}
