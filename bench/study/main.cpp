// The study behind docs/guide.md and docs/trade.md. Each part is a word: espalier_bench_study PART [OPTION...]
// [MESH...]
#include "../program.hpp"

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
    constexpr Subject subjects[] = {
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
    return run_subject("espalier_bench_study", subjects, count, words);
}
