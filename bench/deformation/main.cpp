// Meshes that change: refit beside peers, rays after it beside those after a bake, and boxes along the axes beside
// oriented ones. One thread; one JSON object a line.
#include <algorithm>

#include "../../tests/support/meshes/files.hpp"
#include "../program.hpp"
#include "subject.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

struct Part {
    const char* name;
    void (*measure)(const Subject&);
};
constexpr Part all_parts[] = {{"refits", measure_refits},
                              {"nodes", measure_nodes},
                              {"bakes", measure_bakes},
                              {"rays", measure_rays},
                              {"boxes", measure_boxes}};

void run(Mesh mesh, const Options& options) {
    const Subject subject(std::move(mesh), options);
    for (const Part& part : all_parts)
        if (options.parts.empty() ||
            std::find(options.parts.begin(), options.parts.end(), part.name) != options.parts.end())
            part.measure(subject);
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program(
        "espalier_bench_deformation",
        "A cloth and meshes that bend, twist, wave, fold, collapse and shake: refit beside peers, rays after "
        "it, and boxes of two kinds; JSON");
    program.allow_no_meshes();
    std::vector<std::string> parts;
    for (const Part& part : all_parts) parts.emplace_back(part.name);
    program.add_number("--cloth", options.cloth, std::size_t{0}, std::size_t{2000},
                       "Squares along a side of the cloth; 0: no cloth");
    program.add_count("--times", options.times, "Poses of each motion");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the median counts");
    program.add_count("--rays", options.rays, "Incoherent rays into each pose");
    program.add_number("--bits", options.bits, 1u, 24u, "Lattice bits of Espalier");
    program.add_choices("--part", options.parts, parts, "Only this part; may be repeated");
    program.add_words("--only", options.only,
                      "Only this system beside Espalier, by how its name begins: embree, fcl aabb; may be repeated");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        if (options.cloth > 0) run(make_cloth(options.cloth), options);
        for (const std::string& file : meshes) run(tests::read_mesh(file), options);
    });
}
