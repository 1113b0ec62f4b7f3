// query: one question to a blob. Each family of kinds is in query/<family>.cpp.
#include "base/numbers.hpp"
#include "base/verb_arguments.hpp"
#include "query/kinds.hpp"

namespace espalier::tools {

std::string words_text(const QueryKind& kind) {
    std::string result;
    for (const QueryWord& word : kind.words) {
        result += text(result.empty() ? "" : ", ", word.name, word.count == 3 ? " x y z" : "");
    }
    return result;
}

unsigned word_count(const QueryKind& kind) {
    unsigned count = 0;
    for (const QueryWord& word : kind.words) count += word.count;
    return count;
}

const QueryKinds& query_kinds() {
    static const QueryKinds kinds = [] {
        QueryKinds all;
        for (const QueryKinds& family :
             {ray_kinds(), overlap_kinds(), distance_kinds(), sweep_kinds(), pair_kinds(), blob_kinds()}) {
            all.insert(all.end(), family.begin(), family.end());
        }
        return all;
    }();
    return kinds;
}

ExitCode run_query(const QueryKind& kind, const QueryArguments& arguments) {
    QueryCall call(kind, arguments);
    return print_answer(kind.name, kind.ask(call));
}

}  // namespace espalier::tools
