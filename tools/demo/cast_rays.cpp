// espalier_demo_rays MESH.obj BLOB.espl PICTURE.png: opens the blob, casts a million rays at it, and reports in five
// lines what the demo made.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include <espalier/espalier.hpp>

namespace {

using namespace espalier;

class Random {
public:
    float between(float low, float high) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return low + (high - low) * (static_cast<float>(state_ >> 40) * 0x1p-24f);
    }
    Vec3 point_in(const Vec3& low, const Vec3& high) {
        const float x = between(low.x, high.x);
        const float y = between(low.y, high.y);
        return {x, y, between(low.z, high.z)};
    }

private:
    std::uint64_t state_ = 1;
};

double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Tally {
    std::uint32_t rays = 0;
    std::uint32_t hits = 0;
    std::uint32_t triangles_seen = 0;
};

// From anywhere in a box three times the asset's size towards anywhere inside it.
Tally cast(const Blob& blob, std::uint32_t count) {
    const Vec3 low = blob.bounds().min;
    const Vec3 high = blob.bounds().max;
    const Vec3 size{high.x - low.x, high.y - low.y, high.z - low.z};
    const Vec3 outer_low{low.x - size.x, low.y - size.y, low.z - size.z};
    const Vec3 outer_high{high.x + size.x, high.y + size.y, high.z + size.z};
    std::vector<bool> seen(blob.triangle_count());
    Random random;
    Tally tally;
    for (; tally.rays < count; ++tally.rays) {
        const Vec3 from = random.point_in(outer_low, outer_high);
        const Vec3 to = random.point_in(low, high);
        const RayHit hit = raycast(blob, {.origin = from, .direction = {to.x - from.x, to.y - from.y, to.z - from.z}});
        if (!hit) continue;
        ++tally.hits;
        if (!seen[hit.triangle.index]) ++tally.triangles_seen;
        seen[hit.triangle.index] = true;
    }
    return tally;
}

/// Reads a whole file; returns false at an error, whose reason is in errno.
bool read_file(const char* path, std::vector<char>& bytes) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path, "rb"), std::fclose);
    if (!file) return false;
    constexpr std::size_t chunk = std::size_t{1} << 20;
    for (std::size_t count = chunk; count == chunk;) {
        const std::size_t have = bytes.size();
        bytes.resize(have + chunk);
        count = std::fread(bytes.data() + have, 1, chunk, file.get());
        bytes.resize(have + count);
    }
    return std::ferror(file.get()) == 0;
}

double kilobytes(const char* path) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    return error ? 0.0 : static_cast<double>(bytes) / 1024.0;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 4) {
        std::fputs("usage: espalier_demo_rays MESH.obj BLOB.espl PICTURE.png\n", stderr);
        return 1;
    }
    std::vector<char> bytes;
    if (!read_file(arguments[2], bytes)) {
        std::perror(arguments[2]);
        return 2;
    }
    Blob blob;
    const double open_seconds = seconds_of([&] { blob = open(std::as_bytes(std::span(bytes))); });
    if (!blob) {
        std::fprintf(stderr, "espalier_demo_rays: %s: %s\n", arguments[2], describe(blob.status()));
        return 3;
    }
    Tally tally;
    const double ray_seconds = seconds_of([&] { tally = cast(blob, 1'000'000); });

    std::printf("mesh     %u triangles, %.0f KiB of OBJ text: %s\n", blob.triangle_count(), kilobytes(arguments[1]),
                arguments[1]);
    std::printf("blob     %.0f KiB, %.2f bytes a triangle, at most %.3g from the mesh: %s\n", kilobytes(arguments[2]),
                static_cast<double>(blob.size()) / blob.triangle_count(), static_cast<double>(blob.max_error()),
                arguments[2]);
    std::printf("open     proved every byte of it in %.2f ms; tree of depth %u, nothing decoded, nothing allocated\n",
                open_seconds * 1e3, blob.depth());
    std::printf("rays     %u closest hits on one core in %.2f s; %u hit, %u of the triangles were seen\n", tally.rays,
                ray_seconds, tally.hits, tally.triangles_seen);
    std::printf("picture  %s, %.0f KiB\n", arguments[3], kilobytes(arguments[3]));
    return tally.hits == 0 ? 4 : 0;
}
