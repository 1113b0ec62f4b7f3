// Espalier beside its peers, on the same vertices and the same rays, asked for the same outputs (t, u, v, normal, id).
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "measure.hpp"
#include "options.hpp"
#include "print.hpp"
#include "system.hpp"

namespace {

using namespace espalier::bench;

std::string known_systems(const std::vector<Maker>& makers) {
    std::string names;
    for (const Maker& maker : makers) names += "\n  " + maker.name + "/" + maker.profile;
    return names;
}

/// Every --system must name something.
void check_systems(const Options& options, const std::vector<Maker>& makers) {
    for (const std::string& system : options.systems) {
        const auto named = [&system](const Maker& m) { return system == m.name || system == m.name + "/" + m.profile; };
        if (std::none_of(makers.begin(), makers.end(), named))
            throw std::invalid_argument(
                "there is no system '" + system +
                "' in this build; peers are compiled where they are installed. There are:" + known_systems(makers));
    }
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_peers", "Espalier beside its peers, on the same vertices and the same rays");
    add_options(program, options);
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        std::vector<Maker> makers = all_makers(options.bake);
        check_systems(options, makers);
        std::erase_if(makers, [&options](const Maker& maker) { return !is_asked_for(maker, options); });
        if (std::none_of(makers.begin(), makers.end(), is_reference))
            std::fprintf(
                stderr,
                "espalier_bench_peers: built without Embree 3 (libembree-dev), which ratios are taken to: they are "
                "null, and so is what disagrees\n");
        for (const std::string& path : meshes) {
            const MeshResult result = measure(path, makers, options);
            options.json ? print_json(result, options) : print_table(result, options);
        }
    });
}
