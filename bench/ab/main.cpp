// Two commits of the library, each a shared object (side.h), answer the same questions in turns within one process.
// tools/dev ab builds the two and runs this.

#include "../../tests/support/meshes/level_maker.hpp"
#include "../../tools/base/choices.hpp"
#include "../program.hpp"
#include "turns.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

struct Options {
    std::string base_file, other_file;
    std::vector<std::string> profiles, questions;
    std::string set = "best";
    Turns turns;
    std::size_t loads = 5;
    std::size_t single_questions = 0;
};

/// A file, or one of the meshes that the tests make.
Mesh mesh_named(const std::string& word) {
    Mesh mesh;
    if (word == "torus") mesh = tests::make_torus(300, 100, 3.0, 1.0);
    else if (word == "terrain") mesh = tests::make_terrain(256, 1);
    else if (word == "level") mesh = tests::make_level(20'000, 1);
    else if (word == "small_mesh") mesh = tests::make_terrain(10, 1);
    else if (word == "tiny_mesh") mesh = tests::make_cube(-1.0f, 1.0f);
    else return tests::read_mesh(word);
    mesh.name = word;
    return mesh;
}

/// Returns whether one question of a kind has an answer other than no; false where the side has no such query.
bool finds(const bench::Instance& instance, const char* name, const std::vector<float>& numbers) {
    const EspalierSideKind* kind = instance.calls().kind(name);
    if (kind == nullptr) return false;
    const Memory question(kind->question_bytes), answer(kind->answer_bytes);
    kind->prepare(numbers.data(), 1, question.data());
    kind->run(&instance.asset(), question.data(), 1, answer.data());
    std::uint64_t digest = 0;
    kind->digest(answer.data(), 1, &digest);
    return digest != 0;
}

void compare(const std::string& word, const Options& options, Heading& heading) {
    Mesh mesh = mesh_named(word);
    bring_to_common_size(mesh);
    std::vector<QuestionSet> sets;
    for (const std::string& profile : options.profiles) {
        const SideOfMesh base = bake_with(options.base_file, mesh, profile, heading.bits);
        const SideOfMesh other = bake_with(options.other_file, mesh, profile, heading.bits);
        std::vector<PairOfInstances> pairs;
        for (std::size_t i = 0; i < options.loads; ++i) pairs.emplace_back(base, other, options.set);
        const PairOfInstances& any = pairs.front();
        const auto collides = [&](const Transform& pose) { return finds(any.base(), "collides", numbers_of(pose)); };
        const auto touches = [&](Vec3 p, float radius) {
            return finds(any.base(), "overlaps_sphere", {p.x, p.y, p.z, radius});
        };
        if (sets.empty())
            for (const std::string& name : options.questions)
                sets.push_back(make_questions(name, mesh, collides, touches));
        heading.base_compiler = any.base().calls().compiler;
        heading.other_compiler = any.other().calls().compiler;
        const Baking baking = {mesh.name,
                               profile,
                               any.base().set(),
                               mesh.triangles.size(),
                               base.bytes.size(),
                               other.bytes.size(),
                               base.bytes == other.bytes};
        for (const QuestionSet& set : sets) {
            auto comparison = take_turns(pairs, set, options.turns);
            if (comparison && options.single_questions > 0)
                comparison->slow_cases = slow_cases(any.other(), set, options.single_questions);
            print_row(heading, baking, set.name, comparison);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    Options options;
    options.profiles = names_of(tools::profile_choices);
    options.questions = question_names();
    Heading heading;
    Program program("espalier_bench_ab",
                    "Two commits answer the same questions in turns; a MESH is a file, or torus, terrain, level, "
                    "small_mesh or tiny_mesh; JSON");
    program.add_word("--base", options.base_file, "Shared object of the one side");
    program.add_word("--other", options.other_file, "Shared object of the other side");
    program.add_word("--base-name", heading.base, "What the report calls it");
    program.add_word("--other-name", heading.other, "What the report calls it");
    program.add_words("--profile", options.profiles, "Only this profile; may be repeated",
                      names_of(tools::profile_choices));
    program.add_words("--questions", options.questions, "Only this row; may be repeated", question_names());
    program.add_word("--set", options.set, "Instruction set: scalar, sse42, avx2, avx512 or the best there is",
                     {"scalar", "sse42", "avx2", "avx512", "neon", "best"});
    program.add_number("--bits", heading.bits, 1u, 24u, "Of the lattice");
    program.add_number("--seconds", options.turns.seconds, 0.0, 1e6, "Processor time of a row");
    program.add_number("--slice", options.turns.slice_milliseconds, 0.0, 1e6, "Milliseconds of a turn");
    program.add_number("--loads", options.loads, std::size_t{1}, std::size_t{1000},
                       "How often each side is loaded, with a copy of the bytes each");
    program.add_count("--slow-cases", options.single_questions,
                      "Also times so many questions one by one: the other side's median and 99th percentile");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        if (options.base_file.empty() || options.other_file.empty())
            throw std::invalid_argument("--base and --other are required");
        for (const std::string& word : meshes) compare(word, options, heading);
    });
}
