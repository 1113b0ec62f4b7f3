#include "comparing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "expecting.hpp"
#include "support/base/profiles.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests {

namespace {

void remember(std::uint32_t word, void* words) { static_cast<std::vector<std::uint32_t>*>(words)->push_back(word); }

using Ask = void (*)(asking*);
using Expect = void (Expecting::*)();

/// The same question from both sides.
void compare(const std::string& family, Ask ask, Expect expect, const espalier_blob& c_blob,
             const espalier_blob& c_other, const Blob& blob, const Blob& other, const question& asked) {
    CAPTURE(family);
    std::vector<std::uint32_t> told;
    asking from_c = {&c_blob, &c_other, &asked, remember, &told, 0};
    ask(&from_c);
    Expecting expecting(blob, other, asked);
    (expecting.*expect)();
    const std::vector<std::uint32_t>& expected = expecting.words();
    REQUIRE(told.size() == expected.size());
    const auto word = std::mismatch(told.begin(), told.end(), expected.begin()).first - told.begin();
    REQUIRE(static_cast<std::size_t>(word) == told.size());
}

}  // namespace

question some_question(const Blob& blob, Random& random) {
    question result = {};
    for (espalier_vec3& point : result.points) point = c(some_point(blob, random));
    const Vec3 size = {blob.bounds().max.x - blob.bounds().min.x, blob.bounds().max.y - blob.bounds().min.y,
                       blob.bounds().max.z - blob.bounds().min.z};
    for (espalier_vec3& direction : result.directions) {
        const Vec3 unit = random.in_cube(1.0f);
        direction = random.below(6) == 0 ? c(some_point(blob, random))
                                         : espalier_vec3{unit.x * size.x, unit.y * size.y, unit.z * size.z};
    }
    for (float& length : result.lengths) length = some_length(blob, random);
    for (float& number : result.rotation)
        number = random.below(12) == 0 ? some_length(blob, random) : random.signed_unit();
    result.bits = static_cast<std::uint32_t>(random.next());
    return result;
}

void compare_all(const espalier_blob& c_blob, const espalier_blob& c_other, const Blob& blob, const Blob& other,
                 const question& asked) {
    const auto both = [&](const std::string& family, Ask ask, Expect expect) {
        compare(family, ask, expect, c_blob, c_other, blob, other, asked);
    };
    both("lookups", ask_lookups, &Expecting::lookups);
    both("rays", ask_rays, &Expecting::rays);
    both("volumes", ask_volumes, &Expecting::volumes);
    both("points", ask_points, &Expecting::points);
    both("sweeps", ask_sweeps, &Expecting::sweeps);
    both("pairs", ask_pairs, &Expecting::pairs);
    both("transforms", ask_transforms, &Expecting::transforms);
    both("approximations", ask_approximations, &Expecting::approximations);
    both("walks", ask_walks, &Expecting::walks);
    both("steps", ask_steps, &Expecting::steps);
    both("nothing", ask_nothing, &Expecting::nothing);
}

espalier_blob open_from_c(std::span<const std::byte> bytes) {
    espalier_blob blob;
    REQUIRE(espalier_open(bytes.data(), bytes.size(), &blob) == ESPALIER_OPEN_OK);
    return blob;
}

OpenedBlob blob_with_everything(Profile profile) {
    Mesh mesh = make_torus(12, 8, 2.0, 0.5);
    mesh.materials.resize(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) mesh.materials[i] = static_cast<std::uint32_t>(i * 77);
    return {mesh, with_every_section(profile)};
}

OpenedBlob blob_with_copies() {
    BakeOptions options = with_profile(Profile::fast);
    options.build.builder = Builder::spatial_splits;
    options.build.duplicate_budget = 1.0;
    return {make_soup(60, 1), options};
}

}  // namespace espalier::tests
