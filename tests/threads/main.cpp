// Threads that bake and ask at the same time, for the thread sanitizer: it ends the program where two of them touch the
// same bytes without order. What they find is compared too.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "../platform/answers.hpp"

namespace {

using namespace espalier;

constexpr std::uint32_t side = 64;  // 8192 triangles: enough that the baker shares its work between threads
constexpr unsigned askers = 4;
constexpr std::uint32_t questions = 40;  // of a kind

struct Ground {
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;
};

Ground make_ground() {
    Ground ground;
    for (std::uint32_t i = 0; i < (side + 1) * (side + 1); ++i) {
        const auto height = static_cast<float>(i * 2654435761u >> 24) * 0x1p-6f;
        ground.positions.push_back({static_cast<float>(i % (side + 1)), static_cast<float>(i / (side + 1)), height});
    }
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::uint32_t a = i / side * (side + 1) + i % side;
        ground.triangles.push_back({a, a + 1, a + side + 2});
        ground.triangles.push_back({a, a + side + 2, a + side + 1});
    }
    return ground;
}

std::vector<std::byte> bake_by(Builder builder, const Ground& ground, unsigned threads) {
    const MeshView view = {.positions = ground.positions, .triangles = ground.triangles};
    BakeOptions options;
    options.build.builder = builder;
    options.threads = threads;
    options.effort = Effort::fast;
    options.progress = [](const char*, double) {};
    if (builder == Builder::spatial_splits) options.profile = Profile::fast;
    auto baked = bake({&view, 1}, options);
    return baked ? std::move(baked.bytes) : std::vector<std::byte>();
}

/// The first call of each thread also races to find out the instruction set.
bool ask_at_the_same_time(const std::vector<std::byte>& bytes) {
    const Blob blob = open(bytes);
    if (!blob) return false;
    std::vector<std::uint64_t> found(askers);
    {
        std::vector<std::thread> threads;
        for (unsigned i = 0; i < askers; ++i) {
            threads.emplace_back([&, i] { found[i] = platform::ask_everything(blob, questions).fingerprint.value(); });
        }
        for (std::thread& thread : threads) thread.join();
    }
    return std::count(found.begin(), found.end(), found[0]) == askers;
}

}  // namespace

int main() {
    const Ground ground = make_ground();
    for (const Builder builder : {Builder::binned_sah, Builder::sweep_sah, Builder::spatial_splits,
                                  Builder::agglomerative, Builder::linear, Builder::insertion}) {
        const std::vector<std::byte> bytes = bake_by(builder, ground, 4);
        if (bytes.empty() || bytes != bake_by(builder, ground, 1)) {
            std::fprintf(stderr, "builder %u: other bytes with 4 threads\n", static_cast<unsigned>(builder));
            return 1;
        }
        if (!ask_at_the_same_time(bytes)) {
            std::fprintf(stderr, "builder %u: other answers at the same time\n", static_cast<unsigned>(builder));
            return 2;
        }
    }
    std::puts("6 builders with 4 threads, 4 threads asking each blob: no race");
    return 0;
}
