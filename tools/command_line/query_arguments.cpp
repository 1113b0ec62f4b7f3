// The command line of `espalier query`, made from the table of kinds.
#include <limits>
#include <memory>

#include <import/base/numbers.hpp>

#include "arguments.hpp"
#include "query/kinds.hpp"

namespace espalier::tools {

namespace {

/// Options of which only one makes sense.
void exclude_each_other(const std::vector<Option>& options) {
    for (std::size_t i = 0; i < options.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) Option(options[i]).excludes(options[j]);
    }
}

void exclude_all(Option option, const std::vector<Option>& others) {
    for (const Option& other : others) option.excludes(other);
}

/// The options of one kind of query.
class KindOptions {
public:
    KindOptions(Verb verb, const QueryKind& kind, QueryArguments& arguments)
        : verb_(verb), kind_(kind), arguments_(arguments) {}

    void add() {
        add_modes();
        if (takes(option_limit))
            exclude_all(option("--limit", arguments_.limit, "COUNT", "List no more than that"), modes_);
        if (takes(option_from)) {
            const bool of_pairs = kind_.is_of_scenes_only;
            const char* description = of_pairs ? "List from this pair on, counted from 0, to go on after a --limit"
                                               : "List from this triangle on, to go on after a --limit";
            exclude_all(option("--from", arguments_.from, of_pairs ? "PAIR" : "TRIANGLE", of(option_from, description)),
                        modes_);
        }
        if (takes(option_t_range)) {
            option("--t-min", arguments_.t_min, "T", "Hits before this t do not count").with_default();
            option("--t-max", arguments_.t_max, "T", "Hits beyond this t do not count").with_default();
        }
        if (takes(option_culling)) {
            const Choices<FaceCulling> culling{
                {"none", FaceCulling::none}, {"back", FaceCulling::back}, {"front", FaceCulling::front}};
            verb_.choice("--culling", arguments_.culling, culling,
                         "Which sides of triangles are ignored; none without it");
        }
        if (takes(option_max_distance)) {
            option("--max-distance", arguments_.max_distance, "DISTANCE", "Nothing beyond it is found").with_default();
        }
        if (takes(option_placement)) {
            option("--rotate", arguments_.rotation, "X Y Z W",
                   "How the other blob is turned, a quaternion; 0 0 0 1 without it")
                .expected(4);
            option("--move", arguments_.translation, "X Y Z",
                   "Where 0 0 0 of the other blob's source stands in the first one's; 0 0 0 without it")
                .expected(3);
            option("--scale", arguments_.scale, "FACTOR", "The other blob's size").with_default();
        }
        if (takes(option_work_limit)) {
            option("--work-limit", arguments_.work_limit, "PAIRS",
                   "Pairs of nodes that may be visited; when they do not suffice, exit status 6. Without it all");
        }
        if (takes(option_mask)) {
            option("--mask", arguments_.mask, "BITS",
                   "Of scenes: pass over instances whose mask has no bit in common with this one; without it none");
        }
        if (takes(option_depth)) {
            option("--depth", arguments_.depth, "LEVELS", "Nodes down to this level; 1 is the root's");
        }
    }

private:
    template <class Target>
    Option option(const char* name, Target& target, const char* type, const std::string& description) {
        return verb_.option(name, target, type, description);
    }
    [[nodiscard]] bool takes(QueryOption option) const {
        return ((kind_.options | kind_.scene_options.value_or(0)) & option) != 0;
    }
    [[nodiscard]] std::string of(QueryOption option, const char* description) const {
        const bool not_of_scenes = kind_.scene_options && (*kind_.scene_options & option) == 0;
        return std::string(description) + (not_of_scenes ? "; of blobs only" : "");
    }

    void add_modes() {
        if (takes(option_any)) modes_.push_back(verb_.flag("--any", arguments_.any, "Only whether there is any"));
        if (takes(option_all)) modes_.push_back(verb_.flag("--all", arguments_.all, "Every hit, in storage order"));
        if (takes(option_crossings)) {
            modes_.push_back(verb_.flag(
                "--crossings", arguments_.crossings,
                of(option_crossings, "Every crossing of the surface, once also at shared edges and vertices")));
        }
        if (takes(option_sweep)) {
            verb_.flag("--ignore-leaving", arguments_.ignore_leaving,
                       "Ignores triangles that are touched at the start and that the shape gets no deeper into");
            option("--skin", arguments_.skin, "DISTANCE", "How far the shape stops from the plane of the contact")
                .with_default();
        }
        if (takes(option_few)) verb_.flag("--few", arguments_.few, "The four or fewer that support the body best");
        if (takes(option_first)) {
            modes_.push_back(option("--first", arguments_.first, "COUNT",
                                    of(option_first, "As many as that, sorted, the nearest first")));
        }
        if (takes(option_accuracy)) {
            modes_.push_back(option(
                "--accuracy", arguments_.accuracy, "LENGTH",
                of(option_accuracy, "An answer that may err by about this length, on the safe side, for less work")));
        }
        exclude_each_other(modes_);
    }

    Verb verb_;
    const QueryKind& kind_;
    QueryArguments& arguments_;
    std::vector<Option> modes_;
};

void add_words(Verb verb, const QueryKind& kind, QueryArguments& arguments) {
    if (kind.words.empty()) return;
    const bool is_repeated = kind.repeats.which != Repeats::Which::none;
    verb.option("words", arguments.words, "", words_text(kind))
        .required()
        .expected(static_cast<int>(least_count(kind)),
                  is_repeated ? std::numeric_limits<int>::max() / 2 : static_cast<int>(word_count(kind)));
}

/// At the end of the help.
constexpr const char* units_help =
    "Lengths and coordinates take units (0.5mm); a bare number is in the unit of the blob, metres. inf and nan are\n"
    "numbers. Places are those of the source, also if the blob has an origin.\n";

ExitCode run_query(const QueryKind& kind, const QueryArguments& arguments) {
    QueryCall call(kind, arguments);
    try {
        const Answer answer = kind.run(call);
        return print_answer(kind.name, answer, reason_of(kind, arguments, call.origin(), answer.status));
    } catch (const QueryRefusal& refusal) {
        return print_answer(kind.name, Answer(call, refusal.status), refusal.reason);
    }
}

}  // namespace

void add_query(Verb query) {
    const auto arguments = std::make_shared<QueryArguments>();
    add_blob(query, arguments->blob);
    add_json(query, arguments->json);  // before the kind as well as after it
    query.footer(text("'espalier query BLOB KIND --help' has the arguments and options.\n", units_help,
                      "With --json a miss has the keys of a hit, which are null.\n"));
    for (const QueryKind& kind : query_kinds()) {
        const bool is_of_both = kind.scene_options && !kind.is_of_scenes_only;
        Verb verb = query.below(kind.name, text(kind.help, is_of_both ? " (also of scenes)" : ""), kind.family);
        add_words(verb, kind, *arguments);
        KindOptions(verb, kind, *arguments).add();
        add_json(verb, arguments->json);
        verb.footer(words_help(kind) + units_help);
        verb.runs([&kind, arguments] { return run_query(kind, *arguments); });
    }
}

}  // namespace espalier::tools
