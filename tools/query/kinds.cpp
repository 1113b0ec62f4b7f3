#include "kinds.hpp"

#include "base/numbers.hpp"

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
        for (const QueryKinds& family : {ray_kinds(), overlap_kinds(), distance_kinds(), contact_kinds(), sweep_kinds(),
                                         pair_kinds(), blob_kinds(), scene_kinds(), scene_pair_kinds()}) {
            all.insert(all.end(), family.begin(), family.end());
        }
        return all;
    }();
    return kinds;
}

}  // namespace espalier::tools
