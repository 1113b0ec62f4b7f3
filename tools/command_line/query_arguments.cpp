// The command line of `espalier query`, made from the table of kinds.
#include <limits>
#include <memory>

#include "arguments.hpp"
#include "commands/commands.hpp"
#include "query/kinds.hpp"

namespace espalier::tools {

namespace {

void add_placement(CLI::App* verb, QueryArguments& arguments) {
    verb->add_option("--rotate", arguments.rotation, "How the other blob is turned, a quaternion; 0 0 0 1 without it")
        ->expected(4)
        ->type_name("X Y Z W");
    verb->add_option("--move", arguments.translation, "Where the other blob's origin stands; 0 0 0 without it")
        ->expected(3)
        ->type_name("X Y Z");
    verb->add_option("--scale", arguments.scale, "The other blob's size")->capture_default_str()->type_name("FACTOR");
}

void add_work_limit(CLI::App* verb, QueryArguments& arguments) {
    verb->add_option("--work-limit", arguments.work_limit,
                     "Pairs of nodes that may be visited; when they do not suffice, exit status 6. Without it all")
        ->type_name("PAIRS");
}

/// Options of which only one makes sense.
void exclude_each_other(const std::vector<CLI::Option*>& options) {
    for (std::size_t i = 0; i < options.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) options[i]->excludes(options[j]);
    }
}

void add_options(CLI::App* verb, const QueryKind& kind, QueryArguments& arguments) {
    const unsigned options = kind.options | kind.scene_options.value_or(0);
    const auto takes = [options](QueryOption option) { return (options & option) != 0; };
    const auto of = [&kind](QueryOption option, const char* text) {
        const bool not_of_scenes = kind.scene_options && (*kind.scene_options & option) == 0;
        return std::string(text) + (not_of_scenes ? "; of blobs only" : "");
    };
    std::vector<CLI::Option*> modes;
    if (takes(option_any)) modes.push_back(verb->add_flag("--any", arguments.any, "Only whether there is any"));
    if (takes(option_all)) modes.push_back(verb->add_flag("--all", arguments.all, "Every hit, in storage order"));
    if (takes(option_crossings)) {
        modes.push_back(verb->add_flag(
            "--crossings", arguments.crossings,
            of(option_crossings, "Every crossing of the surface, once also at shared edges and vertices")));
    }
    if (takes(option_sweep)) {
        verb->add_flag("--ignore-leaving", arguments.ignore_leaving,
                       "Ignores triangles that are touched at the start and that the shape gets no deeper into");
        verb->add_option("--skin", arguments.skin, "How far the shape stops from the plane of the contact")
            ->capture_default_str()
            ->type_name("DISTANCE");
    }
    if (takes(option_few)) verb->add_flag("--few", arguments.few, "The four or fewer that support the body best");
    if (takes(option_first)) {
        modes.push_back(
            verb->add_option("--first", arguments.first, of(option_first, "As many as that, sorted, the nearest first"))
                ->type_name("COUNT"));
    }
    if (takes(option_accuracy)) {
        modes.push_back(verb->add_option("--accuracy", arguments.accuracy,
                                         of(option_accuracy,
                                            "An answer that may err by about this length, on the safe "
                                            "side, for less work"))
                            ->type_name("LENGTH"));
    }
    exclude_each_other(modes);
    if (takes(option_limit)) {
        CLI::Option* limit = verb->add_option("--limit", arguments.limit, "List no more than that")->type_name("COUNT");
        for (CLI::Option* mode : modes) limit->excludes(mode);
    }
    if (takes(option_from)) {
        const bool is_of_pairs = kind.is_of_scenes_only;
        CLI::Option* from =
            verb->add_option(
                    "--from", arguments.from,
                    of(option_from, is_of_pairs ? "List from this pair on, counted from 0, to go on after a --limit"
                                                : "List from this triangle on, to go on after a --limit"))
                ->type_name(is_of_pairs ? "PAIR" : "TRIANGLE");
        for (CLI::Option* mode : modes) from->excludes(mode);
    }
    if (takes(option_t_range)) {
        verb->add_option("--t-min", arguments.t_min, "Hits before this t do not count")
            ->capture_default_str()
            ->type_name("T");
        verb->add_option("--t-max", arguments.t_max, "Hits beyond this t do not count")
            ->capture_default_str()
            ->type_name("T");
    }
    if (takes(option_culling)) {
        const Choices<FaceCulling> culling{
            {"none", FaceCulling::none}, {"back", FaceCulling::back}, {"front", FaceCulling::front}};
        add_choice(verb, "--culling", arguments.culling, culling,
                   "Which sides of triangles are ignored; none without it");
    }
    if (takes(option_max_distance)) {
        verb->add_option("--max-distance", arguments.max_distance, "Nothing beyond it is found")
            ->capture_default_str()
            ->type_name("DISTANCE");
    }
    if (takes(option_placement)) add_placement(verb, arguments);
    if (takes(option_work_limit)) add_work_limit(verb, arguments);
    if (takes(option_mask)) {
        verb->add_option(
                "--mask", arguments.mask,
                "Of scenes: pass over instances whose mask has no bit in common with this one; without it none")
            ->type_name("BITS");
    }
    if (takes(option_depth)) {
        verb->add_option("--depth", arguments.depth, "Nodes down to this level; 1 is the root's")->type_name("LEVELS");
    }
}

void add_words(CLI::App* verb, const QueryKind& kind, QueryArguments& arguments) {
    if (kind.words.empty()) return;
    const int count = static_cast<int>(word_count(kind));
    const bool is_repeated = kind.repeats.which != Repeats::Which::none;
    verb->add_option("words", arguments.words, words_text(kind))
        ->required()
        ->expected(static_cast<int>(least_count(kind)), is_repeated ? std::numeric_limits<int>::max() / 2 : count)
        ->type_name("");
}

}  // namespace

void add_query(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<QueryArguments>();
    CLI::App* query = add_verb(app, "query", "Answer one query of a blob or a scene");
    add_blob(query, arguments->blob);
    add_json(query, arguments->json);  // before the kind as well as after it
    query->require_subcommand(1);
    query->footer(
        std::string("'espalier query BLOB KIND --help' has the options. Lengths and coordinates take units (0.5mm), "
                    "or count in the asset's own; inf and nan are numbers.\n") +
        exit_code_help);
    for (const QueryKind& kind : query_kinds()) {
        const bool is_of_both = kind.scene_options && !kind.is_of_scenes_only;
        CLI::App* verb = add_verb(*query, kind.name, text(kind.help, is_of_both ? " (also of scenes)" : ""));
        verb->group(kind.family);
        add_words(verb, kind, *arguments);
        add_options(verb, kind, *arguments);
        add_json(verb, arguments->json);
        verb->callback(
            [&kind, arguments, &chosen] { chosen = [&kind, arguments] { return run_query(kind, *arguments); }; });
    }
}

}  // namespace espalier::tools
