// Instances of a deformable mesh in a moving scene, which follow its poses.
#pragma once

#include <espalier/deformation.hpp>
#include <espalier/scenes/moving_scene.hpp>

#include "support/base/random.hpp"
#include "support/machine/aligned_buffer.hpp"

namespace espalier::fuzz {

class MeshInScene {
public:
    explicit MeshInScene(const Deformable& mesh);
    MeshInScene(const MeshInScene&) = delete;
    MeshInScene& operator=(const MeshInScene&) = delete;

    /// Renews the boxes after a refit of the mesh. Ends the program if the scene then does not open, or if an answer is
    /// not that of the loop over all instances.
    void follow(tests::Random& random);

private:
    Blob mesh_;
    float size_;
    tests::AlignedBuffer memory_;
    MovingScene scene_;
};

}  // namespace espalier::fuzz
