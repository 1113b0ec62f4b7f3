// query: runs one query of a blob. Each family of kinds is in query/<family>.cpp.
#include "commands.hpp"
#include "query/kinds.hpp"

namespace espalier::tools {

ExitCode run_query(const QueryKind& kind, const QueryArguments& arguments) {
    QueryCall call(kind, arguments);
    const Answer answer = kind.run(call);
    return print_answer(kind.name, answer, reason_of(kind, arguments, answer.status));
}

}  // namespace espalier::tools
