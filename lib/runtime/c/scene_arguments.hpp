// Arguments of C for queries of scenes: views of moving scenes, and what a query takes into account.
#pragma once

#include <espalier/scene.hpp>
#include <runtime/c/abi.hpp>

namespace espalier::detail {

/// Returns whether espalier_moving_scene_view() made a scene. Its instances have no records.
inline bool is_view(const SceneView& scene) { return data_of(scene).moving != nullptr || data_of(scene).must_refit; }

/// The triangles that a query takes into account. It must outlive the call.
class Selection {
public:
    Selection(std::uint32_t mask, espalier_scene_filter function, void* user) : mask_(mask), keeps_{function, user} {}

    // NOLINTNEXTLINE(google-explicit-constructor): the argument of a query
    operator SceneFilter() const {
        return {mask_, keeps_.function == nullptr ? SceneTriangleFilter() : SceneTriangleFilter(keeps_)};
    }

private:
    struct Keeps {
        espalier_scene_filter function;
        void* user;
        bool operator()(InstanceId instance, TriangleId triangle) const {
            return function(c(instance), triangle.index, user);
        }
    };
    std::uint32_t mask_;
    Keeps keeps_;
};

}  // namespace espalier::detail
