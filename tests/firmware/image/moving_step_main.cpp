// The least that is useful with a moving scene: an instance inserted, a batch of moves, refit, repack, and the pairs
// whose boxes touch.
#include <espalier/blob.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>

#include "blob_in_image.hpp"

using namespace espalier;

int main() {
    alignas(32) static std::byte block[1024];
    static InstancePair pairs[4];
    const Blob mesh = open_unchecked(firmware::blob_in_image());
    MovingScene scene = create_moving_scene(block, 4, -10, std::span(&mesh, 1));
    const Result<InstanceHandle> first = insert(scene, {}), second = insert(scene, {});
    if (!first || !second) return 2;
    const Movement movements[] = {{*first, {}}, {*second, {}}};
    if (move(scene, movements).status != QueryStatus::ok) return 3;
    if (refit(scene) > 1) repack(scene);
    const auto found = collect_candidate_pairs(scene, pairs);
    end_step(scene);
    return static_cast<int>(found.count);
}
