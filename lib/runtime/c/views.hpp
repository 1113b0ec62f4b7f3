// Scenes of C that are views of moving scenes.
#pragma once

#include <espalier/scene.hpp>

namespace espalier::detail {

/// Returns whether espalier_moving_scene_view() made a scene. Its instances have no records.
inline bool is_view(const BakedScene& scene) { return data_of(scene).moving != nullptr || data_of(scene).must_refit; }

}  // namespace espalier::detail
