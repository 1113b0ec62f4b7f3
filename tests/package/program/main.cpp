// What every consumer builds: opens the blob that the command line names and says what some queries find in it.
#include <cstddef>
#include <cstdio>
#include <vector>

#include <espalier/espalier.hpp>

int main(int argument_count, char** arguments) {
    std::FILE* file = argument_count == 2 ? std::fopen(arguments[1], "rb") : nullptr;
    if (file == nullptr) return 2;
    std::vector<std::byte> bytes(1 << 16);
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file));
    std::fclose(file);

    const espalier::Blob blob = espalier::open(bytes);
    if (!blob) {
        std::puts(espalier::describe(blob.status()));
        return 1;
    }
    const espalier::RayHit hit = espalier::raycast(blob, {.origin = {0.25f, 0.5f, 5}, .direction = {0, 0, -1}});
    unsigned touched = 0;
    const auto status = espalier::for_each_overlap(blob, espalier::Sphere{.center = {3, -3, 0.25f}, .radius = 0.5f},
                                                   [&](espalier::TriangleId) { ++touched; });
    if (espalier::is_refused(status)) return 1;
    std::printf("%u triangles, version %s\n", static_cast<unsigned>(blob.triangle_count()), espalier::library_version);
    std::printf("a ray down: %s, t = %.3f, normal %g %g %g\n", hit ? "hit" : "no hit", static_cast<double>(hit.t),
                static_cast<double>(hit.normal.x), static_cast<double>(hit.normal.y),
                static_cast<double>(hit.normal.z));
    std::printf("a sphere beside the table touches %u\n", touched);
    return 0;
}
