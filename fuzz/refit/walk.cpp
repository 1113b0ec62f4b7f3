#include "refit/walk.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "judge.hpp"
#include "refit/mesh_in_scene.hpp"
#include "refit/pose_maker.hpp"
#include "refit/pose_model.hpp"
#include "support/exercise/exercise.hpp"
#include "support/machine/exact_buffer.hpp"

namespace espalier::fuzz {

using namespace tests;

namespace {

using Bytes = std::vector<std::byte>;

/// Positions above these take too much memory: their number is only a field of the header.
constexpr std::uint32_t most_positions = 70'000;

/// Returns the whole blob of a mesh, written over other bytes.
Bytes sealed(const Deformable& mesh) {
    Bytes bytes(mesh.blob().size(), std::byte{0xA5});
    require(seal(mesh, bytes) == QueryStatus::ok, "seal() has refused its arguments");
    return bytes;
}

/// A deformable mesh whose moving part lies in memory of its own, or in the bytes of its blob.
class Mesh {
public:
    Mesh(std::span<const std::byte> bytes, Random& random)
        : misalignment_(random.below(16)),
          is_in_place_(random.coin()),
          whole_(bytes, misalignment_),
          blob_(open(whole_.bytes())),
          moving_(Bytes(is_in_place_ ? 0 : deformable_bytes(blob_)), misalignment_),
          mesh_(create_deformable(blob_, is_in_place_ ? whole_.bytes() : moving_.bytes())) {
        require(static_cast<bool>(mesh_), "create_deformable() has refused its arguments");
    }
    Mesh(const Mesh&) = delete;
    Mesh& operator=(const Mesh&) = delete;

    [[nodiscard]] Deformable& operator*() { return mesh_; }
    [[nodiscard]] Deformable* operator->() { return &mesh_; }
    /// Returns the moving part and, in place, the rest.
    [[nodiscard]] Bytes memory() {
        const std::span<std::byte> bytes = is_in_place_ ? whole_.bytes() : moving_.bytes();
        return {bytes.begin(), bytes.end()};
    }
    /// Seals the mesh over the blob that it was created from.
    [[nodiscard]] Bytes sealed_in_place() {
        require(seal(mesh_, whole_.bytes()) == QueryStatus::ok, "seal() has refused the bytes of the blob");
        return {whole_.bytes().begin(), whole_.bytes().end()};
    }

private:
    std::size_t misalignment_;
    bool is_in_place_;
    ExactBuffer whole_;
    Blob blob_;
    ExactBuffer moving_;
    Deformable mesh_;
};

/// A walk of poses of one blob.
class Walk {
public:
    Walk(std::span<const std::byte> bytes, Random& random)
        : random_(random),
          bytes_(bytes.begin(), bytes.end()),
          decoded_(decode(bytes)),
          model_(decoded_),
          is_verified_(verify(bytes).sound),
          mesh_(bytes, random),
          scene_(*mesh_) {
        require(mesh_->position_count() == decoded_.position_count, "there is another number of positions");
        require(sealed(*mesh_) == bytes_, "a mesh that has not moved has other bytes");
    }

    void run() {
        if (decoded_.position_count > most_positions) return require_refusal({});
        const auto rest = model_.positions_of_pose();
        Vec3 corner = model_.position_at({0, 0, 0});
        PoseMaker poses(decoded_, model_, rest.value_or(std::vector(decoded_.position_count, corner)));
        for (std::uint32_t left = 1 + random_.below(8); left != 0; --left) {
            const std::vector<Vec3> pose = poses.next(random_);
            if (!model_.result_of(pose)) {
                require_refusal(pose);
                continue;
            }
            move_to(pose);
            poses.keep(pose);
        }
        judge_queries();
        if (rest && is_verified_) {
            move_to(*rest);
            require(last_ == bytes_, "the pose of the bake has other bytes");
        }
        const Bytes separately = sealed(*mesh_);
        require(mesh_.sealed_in_place() == separately, "a mesh that is sealed in place has other bytes");
    }

private:
    void require_refusal(std::span<const Vec3> pose) {
        const Bytes before = mesh_.memory();
        const RefitResult result = refit(*mesh_, pose), expected = model_.result_of(pose);
        require(result.status == expected.status && result.position == expected.position && result.quality == 0.0f,
                "another status or position is returned");
        require(mesh_.memory() == before, "a refusal has changed a byte");
    }

    void move_to(std::span<const Vec3> pose) {
        const RefitResult result = refit(*mesh_, pose);
        require(result && result.position == 0 && result.quality >= 0.0f, "a pose in range is refused");
        last_ = sealed(*mesh_);
        require(static_cast<bool>(open(last_)), "a mesh that has moved does not open");
        model_.check(decode(last_), pose);
        if (is_verified_) require(verify(last_).sound, "a mesh that has moved is not sound");
        require_same_by_other_paths(pose, result.quality);
        scene_.follow(random_);
    }

    /// Moves a mesh that was not moved before, and one that is in the pose already.
    void require_same_by_other_paths(std::span<const Vec3> pose, float quality) {
        for (const Bytes& from : {bytes_, last_}) {
            Mesh other(from, random_);
            const RefitResult result = refit(*other, pose);
            require(result && result.quality == quality, "the same pose has another quality");
            require(sealed(*other) == last_, "the same pose has other bytes");
        }
    }

    void judge_queries() {
        const Bytes whole = sealed(*mesh_);
        const Blob blob = open(whole);
        const std::uint64_t seed = random_.next();
        const bool is_moved = !last_.empty();  // edited bytes need not be sound
        Random of_parts(seed), of_whole(seed);
        require(exercise(mesh_->blob(), of_parts, 1, is_moved) == exercise(blob, of_whole, 1, is_moved),
                "the parts have other answers than the whole blob");
        judge(whole, blob, random_);
    }

    Random& random_;
    Bytes bytes_;
    DecodedBlob decoded_;
    PoseModel model_;
    bool is_verified_;
    Mesh mesh_;
    MeshInScene scene_;
    Bytes last_;  ///< the whole blob in its pose, after the first move
};

}  // namespace

void walk_poses(std::span<const std::byte> bytes, Random& random) { Walk(bytes, random).run(); }

}  // namespace espalier::fuzz
