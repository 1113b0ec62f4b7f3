// The five usual queries and open.
#include <espalier/espalier.hpp>

#include "blob_in_image.hpp"

using namespace espalier;

int main() {
    const Blob blob = open(firmware::blob_in_image());
    if (!blob) return 2;
    const Vec3 middle = {8.0f, 8.0f, 8.0f};
    const Ray ray = {.origin = {8.0f, 8.0f, 50.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    const bool closest = bool(raycast(blob, ray));
    const bool any = occluded(blob, ray).yes();
    const bool sphere = overlaps(blob, Sphere{middle, 1.0f}).yes();
    const bool box = overlaps(blob, Box{middle, {9.0f, 9.0f, 9.0f}}).yes();
    const bool point{closest_point(blob, middle)};
    return (closest ? 1 : 0) + (any ? 2 : 0) + (sphere ? 4 : 0) + (box ? 8 : 0) + (point ? 16 : 0);
}
