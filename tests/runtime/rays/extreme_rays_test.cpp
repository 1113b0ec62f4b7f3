// Rays at the ends of what floats hold, at meshes at the ends of what floats hold: none gets through a closed surface,
// and each finds what the loop over all triangles finds. With subnormal numbers flushed and not.
#include "support/testing.hpp"

#include <string_view>

#include "support/answers/differences.hpp"
#include "support/blobs/extreme_shapes.hpp"
#include "support/machine/float_mode.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/queries/aimed_rays.hpp"

namespace espalier::tests::extreme_rays_test {
namespace {

constexpr auto kinds_of_aim = static_cast<std::uint32_t>(Aim::count);
constexpr std::array<std::string_view, kinds_of_aim> aim_names = {"from inside", "from outside", "from far away",
                                                                  "parallel to an axis", "grazing"};

/// On every instruction set, closest and any.
void require_hit(const Blob& blob, const Ray& ray, unsigned mode) {
    for (const InstructionPath& path : instruction_paths()) {
        bool closest = false, any = false;
        {
            const FloatMode in_mode(mode);
            closest = bool(path.closest_hit(detail::data_of(blob), ray, nullptr));
            any = path.any_hit(detail::data_of(blob), ray, nullptr).yes();
        }
        if (!closest || !any) FAIL(std::string(path.name), ": a leak, mode ", mode, ": ", describe(ray));
    }
}

TEST_CASE("ray: no aimed ray leaks through a closed surface of any size or place or float mode") {
    const std::vector<ExtremeSolid> solids = make_extreme_solids();
    const std::uint64_t count = scaled(300);
    std::array<std::uint64_t, kinds_of_aim> asked{}, proved{};
    for (const ExtremeSolid& solid : solids) {
        CAPTURE(solid.shape.name);
        const Blob& blob = solid.shape.opened.blob;
        const HitProof proof(solid);
        AimedRays rays(solid, 1);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint32_t aim = static_cast<std::uint32_t>(i % kinds_of_aim);
            Ray ray = rays.ray(static_cast<Aim>(aim));
            ++asked[aim];
            detail::LatticeRay rounded;
            if (!detail::round_ray(detail::data_of(blob), ray, rounded)) {
                if (proof.must_not_pass_by(ray)) FAIL("refused: ", describe(ray));
                continue;
            }
            const HitProof::Crossing crossing = proof.crossing(rounded);
            if (crossing == HitProof::Crossing::unproved) continue;
            ++proved[aim];
            const bool leaves = crossing == HitProof::Crossing::leaves;
            if (i % 4 == 0) ray.culling = leaves ? FaceCulling::front : FaceCulling::back;
            require_hit(blob, ray, float_modes[i / kinds_of_aim % float_modes.size()]);
        }
    }
    std::uint64_t all = 0;
    for (std::uint32_t aim = 0; aim < kinds_of_aim; ++aim) {
        MESSAGE("aimed rays ", std::string(aim_names[aim]), ": ", proved[aim], " that must hit, of ", asked[aim]);
        CHECK(proved[aim] > asked[aim] / 10);
        all += proved[aim];
    }
    MESSAGE("aimed rays in all: ", all, " held against a proof on ", instruction_paths().size(),
            " instruction sets, 0 leaks");
}

TEST_CASE("ray: extreme rays at extreme meshes equal the loop in every float mode") {
    const std::uint64_t count = scaled(60);
    std::uint64_t asked = 0, hits = 0;
    const auto require_equal = [&](const Blob& blob, const TriangleLoop& loop, const Ray& ray) {
        const auto difference = ray_difference(blob, loop, ray, hits, float_modes[asked % float_modes.size()]);
        if (difference) FAIL(*difference);
        ++asked;
    };
    for (const ExtremeSolid& solid : make_extreme_solids()) {
        CAPTURE(solid.shape.name);
        const TriangleLoop loop(solid.shape.decoded);
        AimedRays rays(solid, 2);
        for (std::uint64_t i = 0; i < count; ++i) {
            require_equal(solid.shape.opened.blob, loop, rays.ray(static_cast<Aim>(i % kinds_of_aim)));
            require_equal(solid.shape.opened.blob, loop, rays.hostile_ray());
        }
    }
    for (const ExtremeShape& shape : make_extreme_surfaces()) {
        CAPTURE(shape.name);
        const TriangleLoop loop(shape.decoded);
        QueryMaker maker(shape.decoded, 3);
        for (std::uint64_t i = 0; i < 2 * count; ++i) {
            Ray ray = maker.any_ray();
            if (maker.random().below(3) == 0) maker.restrict(ray);
            require_equal(shape.opened.blob, loop, ray);
        }
    }
    CHECK(hits > asked / 4);
    MESSAGE("extreme rays: ", asked, " held against the loop on ", instruction_paths().size(), " instruction sets, ",
            hits, " triangles hit, 0 differences");
}

}  // namespace
}  // namespace espalier::tests::extreme_rays_test
