// Espalier beside its peers, behind docs/benchmarks.md. Each subject is a word: espalier_bench_peers SUBJECT
// [OPTION...] MESH...
#include "../program.hpp"

namespace espalier::bench {

int pairs_subject(int count, char** words);
int points_subject(int count, char** words);
int rays_subject(int count, char** words);
int scenes_subject(int count, char** words);
int sweeps_subject(int count, char** words);

}  // namespace espalier::bench

int main(int count, char** words) {
    using namespace espalier::bench;
    constexpr Subject subjects[] = {{"rays", rays_subject},
                                    {"pairs", pairs_subject},
                                    {"points", points_subject},
                                    {"sweeps", sweeps_subject},
                                    {"scenes", scenes_subject}};
    return run_subject("espalier_bench_peers", subjects, count, words);
}
