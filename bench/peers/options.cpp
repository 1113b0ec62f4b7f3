#include "options.hpp"

#include <charconv>
#include <stdexcept>
#include <string_view>

#include "../../tools/choices.hpp"

namespace espalier::bench {
namespace {

template <class Number>
Number number(const std::string& option, std::string_view word, Number low, Number high) {
    Number value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value < low || value > high)
        throw std::invalid_argument(option + " takes a whole number from " + std::to_string(low) + " to " +
                                    std::to_string(high) + ", not '" + std::string(word) + "'");
    return value;
}

Builder builder(const std::string& word) {
    std::string names;
    for (const auto& [name, value] : tools::builder_choices) {
        if (name == word) return value;
        names += (names.empty() ? "" : ", ") + name;
    }
    throw std::invalid_argument("there is no builder '" + word + "'; there are " + names);
}

}  // namespace

const char* const usage =
    "usage: espalier_bench_peers [OPTION...] MESH.obj|MESH.ply...\n"
    "  --json              a JSON object for each row instead of a table\n"
    "  --system NAME       only this system or NAME/PROFILE beside the reference; may be repeated\n"
    "  --reference-only    the same as --system espalier\n"
    "  --repetitions N     how often every system answers all rays (9)\n"
    "  --builds N          how often every system is built (3)\n"
    "  --rays N            incoherent rays (500000)\n"
    "  --seed N            of the incoherent rays (2026)\n"
    "  --bits N            Espalier's lattice (16)\n"
    "  --effort N          Espalier's build, 0 to 9 (5)\n"
    "  --builder NAME      Espalier's build, by the names of 'espalier bake --builder' (binned_sah)\n";

Options parse(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto value = [&]() -> std::string {
            if (i + 1 >= count) throw std::invalid_argument(word + " needs a value behind it");
            return words[++i];
        };
        if (word == "--help" || word == "-h") options.help = true;
        else if (word == "--json") options.json = true;
        else if (word == "--reference-only") options.systems.emplace_back("espalier");
        else if (word == "--system") options.systems.push_back(value());
        else if (word == "--repetitions") options.repetitions = number(word, value(), 1u, 1000u);
        else if (word == "--builds") options.builds = number(word, value(), 1u, 1000u);
        else if (word == "--rays") options.incoherent = number(word, value(), std::size_t{1}, std::size_t{100'000'000});
        else if (word == "--seed") options.seed = number(word, value(), std::uint64_t{0}, ~std::uint64_t{0});
        else if (word == "--bits") options.bake.bits = number(word, value(), 1u, 24u);
        else if (word == "--effort") options.bake.effort = number(word, value(), 0u, 9u);
        else if (word == "--builder") options.bake.builder = builder(value());
        else if (word.starts_with("-")) throw std::invalid_argument("there is no option '" + word + "'");
        else options.meshes.push_back(word);
    }
    if (options.meshes.empty() && !options.help) throw std::invalid_argument("name at least one mesh, .obj or .ply");
    return options;
}

bool is_asked_for(const Maker& maker, const Options& options) {
    if (options.systems.empty() || is_reference(maker)) return true;
    for (const std::string& system : options.systems)
        if (system == maker.name || system == maker.name + "/" + maker.profile) return true;
    return false;
}

}  // namespace espalier::bench
