// The study behind docs/guide.md and docs/trade.md. Each part is a word: espalier_bench_study PART [OPTION...]
// [MESH...]
#include <cstdio>
#include <string_view>

namespace espalier::bench {

namespace moving {
int part(int count, char** words);
}
int builders_part(int count, char** words);
int cost_model_part(int count, char** words);
int deformation_part(int count, char** words);
int exactness_part(int count, char** words);
int growth_part(int count, char** words);
int ids_part(int count, char** words);
int ladder_part(int count, char** words);
int load_part(int count, char** words);
int obb_part(int count, char** words);
int subdivision_part(int count, char** words);
int traversal_part(int count, char** words);
int volumes_part(int count, char** words);

}  // namespace espalier::bench

int main(int count, char** words) {
    using namespace espalier::bench;
    struct Part {
        std::string_view name;
        int (*run)(int count, char** words);
    };
    constexpr Part parts[] = {
        {"builders", builders_part},
        {"cost_model", cost_model_part},
        {"deformation", deformation_part},
        {"exactness", exactness_part},
        {"growth", growth_part},
        {"ids", ids_part},
        {"ladder", ladder_part},
        {"moving", moving::part},
        {"obb", obb_part},
        {"subdivision", subdivision_part},
        {"traversal", traversal_part},
        {"volumes", volumes_part},
#ifdef __unix__
        {"load", load_part},
#endif
    };
    for (const Part& part : parts)
        if (count > 1 && part.name == words[1]) return part.run(count - 1, words + 1);
    std::fprintf(stderr,
                 "espalier_bench_study PART [OPTION...] [MESH...]; a part's --help lists its options. Parts:\n");
    for (const Part& part : parts) std::fprintf(stderr, "  %s\n", part.name.data());
    return 1;
}
