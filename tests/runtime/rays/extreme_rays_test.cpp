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
            closest = bool(path.closest_hit(detail::data_of(blob), ray, {}));
            any = path.any_hit(detail::data_of(blob), ray, {}).yes();
        }
        if (!closest || !any) FAIL(std::string(path.name), ": a leak, mode ", mode, ": ", describe(ray));
    }
}

/// So many rays of these kinds at each solid, and in each float mode in turn.
void require_no_leak(std::initializer_list<Aim> aims, std::uint64_t count) {
    std::array<std::uint64_t, kinds_of_aim> asked{}, proved{};
    for (const ExtremeSolid& solid : make_extreme_solids()) {
        CAPTURE(solid.shape.name);
        const Blob& blob = solid.shape.opened.blob;
        const HitProof proof(solid);
        AimedRays rays(solid, 1);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Aim aim = aims.begin()[i % aims.size()];
            Ray ray = rays.ray(aim);
            ++asked[static_cast<std::size_t>(aim)];
            detail::LatticeRay rounded;
            if (!detail::round_ray(detail::data_of(blob), ray, rounded)) {
                if (proof.must_not_pass_by(ray)) FAIL("refused: ", describe(ray));
                continue;
            }
            const HitProof::Crossing crossing = proof.crossing(rounded);
            if (crossing == HitProof::Crossing::unproved) continue;
            ++proved[static_cast<std::size_t>(aim)];
            const bool leaves = crossing == HitProof::Crossing::leaves;
            if (i % 4 == 0) ray.culling = leaves ? FaceCulling::front : FaceCulling::back;
            require_hit(blob, ray, float_modes[i / aims.size() % float_modes.size()]);
        }
    }
    std::uint64_t all = 0;
    for (const Aim aim : aims) {
        const auto kind = static_cast<std::size_t>(aim);
        MESSAGE("aimed rays ", std::string(aim_names[kind]), ": ", proved[kind], " that must hit, of ", asked[kind]);
        CHECK(proved[kind] > asked[kind] / 10);
        all += proved[kind];
    }
    MESSAGE("aimed rays in all: ", all, " held against a proof on ", instruction_paths().size(),
            " instruction sets, 0 leaks");
}

// Of any size, in any place, in any float mode; in two cases, so that each core takes one.
TEST_CASE("ray: no extreme ray from inside or outside leaks through a closed surface") {
    require_no_leak({Aim::from_inside, Aim::from_outside}, scaled(120));
}
TEST_CASE("ray: no extreme ray from far away or along an axis or grazing leaks through a closed surface") {
    require_no_leak({Aim::far, Aim::axis_parallel, Aim::grazing}, scaled(180));
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
