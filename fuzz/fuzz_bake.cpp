// Any bytes as a mesh and options: refused with a reason, or baked to a blob that opens, passes the deep check, is
// sound and answers every query as the loop over all its triangles does.
#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "input.hpp"
#include "judge.hpp"
#include "support/meshes/mesh.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;
using fuzz::Input;

namespace {

/// Takes a number of any bits; its bytes lie in the order of the corpus, the highest first.
float any_float(Input& input) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | input.byte();
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

struct Question {
    Mesh mesh;
    BakeOptions options;
};

/// Makes the blob deformable, by options that go together. Its tree suits a pose in which each position is the next
/// one.
void deform(const Mesh& mesh, BakeOptions& options) {
    options.profile = Profile::fast;
    if (options.build.builder == Builder::spatial_splits) options.build.builder = Builder::binned_sah;
    options.drop_bad_triangles = false;
    options.flat_angle = std::nullopt;
    options.bounds = {};
    std::vector<Vec3> pose = mesh.positions;
    if (!pose.empty()) std::rotate(pose.begin(), pose.begin() + 1, pose.end());
    options.deformation.emplace().poses.push_back(std::move(pose));
}

Question read_question(Input& input) {
    Question question;
    BakeOptions& options = question.options;
    const unsigned lattice = input.byte();
    options.resolution = Resolution::bits(1 + lattice % 24);
    constexpr Builder builders[] = {Builder::binned_sah, Builder::sweep_sah, Builder::agglomerative, Builder::linear,
                                    Builder::insertion};
    const unsigned choices = input.byte();
    options.effort = static_cast<Effort>(choices % 10 % 3);
    options.build.builder = builders[choices / 10 % 5];
    options.profile = static_cast<Profile>(choices / 50 % 3);
    if (choices >= 250) {  // which go together
        options.build.builder = Builder::spatial_splits;
        options.profile = Profile::fast;
    }
    const std::uint8_t flags = input.byte();
    options.original_ids = (flags & 1) != 0;
    const unsigned material_width = flags >> 1 & 3u;  // none, 8, 16 or 17 bits
    options.drop_bad_triangles = (flags & 8) != 0;
    options.threads = 1 + (flags >> 4 & 1u);
    const bool raw_floats = (flags & 32) != 0;
    if ((flags & 128) != 0) {
        options.flat_angle = 5.0;
        options.bounds = {true, true, true};
    }
    if ((flags & 64) != 0) options.resolution = Resolution::tolerance(static_cast<double>(any_float(input)));

    Mesh& mesh = question.mesh;
    mesh.name = "fuzzed";
    const unsigned vertices = input.byte();
    for (unsigned i = 0; i < vertices; ++i) {
        // Small integers make the degenerate, coplanar and duplicate cases that random floats never make.
        const auto coordinate = [&] {
            return raw_floats ? any_float(input) : static_cast<float>(static_cast<std::int8_t>(input.byte()));
        };
        const float x = coordinate();
        const float y = coordinate();
        const float z = coordinate();
        mesh.positions.push_back({x, y, z});
    }
    while (!input.empty() && mesh.triangles.size() < 300) {
        const std::uint32_t a = input.byte();
        const std::uint32_t b = input.byte();
        const std::uint32_t c = input.byte();
        mesh.triangles.push_back({a, b, c});
        if (material_width != 0) mesh.materials.push_back(a << (material_width * material_width - 1));
    }
    if (lattice >= 240) deform(mesh, options);
    return question;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return 0;
    Input input(std::span(data, size));
    const Question question = read_question(input);
    const MeshView view = question.mesh.view();
    const auto baked = bake(std::span(&view, 1), question.options);
    if (!baked) {
        if (baked.status == BakeStatus::internal) fuzz::fail("internal error", baked.message);
        if (baked.message.empty()) fuzz::fail("refused", "without a reason");
        return 0;
    }
    const Blob blob = open(baked.bytes);
    if (!blob) fuzz::fail("open", describe(blob.status()));
    if (const auto report = verify(baked.bytes); !report) fuzz::fail("verify", report.message);
    Random random(size);
    fuzz::judge(baked.bytes, blob, random, fuzz::Maker::baker);
    return 0;
}
