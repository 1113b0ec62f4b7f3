// Asks a deformable blob everything in each pose of a walk, and hashes what comes back and the bytes of each pose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/deformation.hpp>
#include <espalier/scenes/moving_scene.hpp>

#include "answers.hpp"
#include "moving_answers.hpp"
#include "poses.hpp"

namespace espalier::platform {

/// A deformable blob with its memory, and instances of it in a moving scene.
class PoseWalk {
public:
    PoseWalk(const Blob& blob, Answers& answers, Fingerprint& bytes)
        : moving_(deformable_bytes(blob)),
          whole_(blob.size()),
          mesh_(create_deformable(blob, moving_)),
          mesh_blob_(mesh_.blob()),
          rest_(mesh_.position_count(), mesh_.range().min),
          pose_(rest_.size()),
          scene_(create_moving_scene(memory_, capacity, -10, {&mesh_blob_, 1})),
          answers_(answers),
          bytes_(bytes) {
        read_positions(mesh_.blob(), rest_);
        hash_.add(mesh_.status(), mesh_.position_count(), mesh_.range().min, mesh_.range().max);
        for (const float scale : {1.0f, 0.5f, 0.25f}) {
            const Vec3 place = {scale * 100.0f, 4.0f, -scale};
            hash_.add(insert(scene_, {{{scale, 0.125f, 0.0f, 1.0f}, place, scale}}).status);
        }
    }

    /// Each pose once, and then the one at rest again.
    void run(std::uint32_t questions_of_a_kind) {
        const Poses poses(mesh_, rest_);
        for (std::uint32_t number = 0; number <= Poses::count; ++number) {
            poses.make(number, pose_);
            refuse_some(number);
            add(refit(mesh_, pose_));
            hash_.add(seal(mesh_, whole_));
            bytes_.add(std::span<const std::byte>(whole_));
            answers_.add(ask_everything(mesh_.blob(), questions_of_a_kind));
            ask_scene(number);
        }
    }

private:
    static constexpr std::uint32_t capacity = 8;

    void add(const RefitResult& result) {
        answers_.calls += 1;
        hash_.add(result.status, result.position, result.quality);
    }
    void refuse_some(std::uint32_t number) {
        add(refit(mesh_, std::span(pose_).first(number)));
        Vec3& position = pose_[(number * 37 + 11) % pose_.size()];
        const Vec3 before = position;
        position.y = number % 2 == 0 ? __builtin_nanf("") : 0x1p100f;
        add(refit(mesh_, pose_));
        position = before;
    }

    void ask_scene(std::uint32_t number) {
        hash_.add(move_instances_of(scene_, 0));
        hash_.add(refit(scene_));
        add_block(bytes_, scene_.bytes());
        for (std::uint32_t i = 0; i < 16; ++i) {
            const Vec3& to = pose_[(i * 101 + number) % pose_.size()];
            const Ray ray = {{25.0f * static_cast<float>(i % 5), -50.0f, 60.0f},
                             {to.x * 0.25f, to.y * 0.25f + 50.0f, to.z * 0.25f - 60.0f}};
            const InScene<RayHit> hit = raycast(scene_, ray);
            hash_.add(hit->status, hit.instance.index, hit ? hit->t : 0.0f);
            const InScene<ClosestPoint> nearest = closest_point(scene_, to);
            hash_.add(nearest.instance.index, nearest->point);
        }
        answers_.calls += 32;
    }

    std::vector<std::byte> moving_, whole_;
    Deformable mesh_;
    Blob mesh_blob_;
    std::vector<Vec3> rest_, pose_;
    alignas(32) std::byte memory_[2048] = {};
    MovingScene scene_;
    Answers& answers_;
    Fingerprint& hash_ = answers_.fingerprint;
    Fingerprint& bytes_;
};

/// The bytes of a blob's poses enter `bytes`.
inline Answers ask_in_poses(const Blob& blob, std::uint32_t questions_of_a_kind, Fingerprint& bytes) {
    Answers answers;
    PoseWalk walk(blob, answers, bytes);
    walk.run((questions_of_a_kind + 9) / 10);
    return answers;
}

}  // namespace espalier::platform
