// The least that is useful with a scene: open it and cast one ray.
#include <espalier/scene.hpp>

#include "blob_in_image.hpp"

int main() {
    static espalier::Blob meshes[4];
    const espalier::BakedScene scene = espalier::open_scene(espalier::firmware::blob_in_image(), meshes);
    if (!scene) return 2;
    const auto hit = espalier::raycast(scene, {.origin = {8.0f, 8.0f, 50.0f}, .direction = {0.0f, 0.0f, -1.0f}});
    return hit ? 0 : 3;
}
