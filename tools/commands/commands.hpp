// The verbs of the command, one file each. Each returns the exit status, or throws CommandError.
#pragma once

#include <cstddef>
#include <span>

#include "base/exit_code.hpp"
#include "base/verb_arguments.hpp"

namespace espalier::tools {

ExitCode run_bake(const BakeArguments& arguments);
ExitCode run_refit(const RefitArguments& arguments);
ExitCode run_embed(const EmbedArguments& arguments);
ExitCode run_trade(const TradeArguments& arguments);
ExitCode run_info(const InfoArguments& arguments);
ExitCode run_verify(const VerifyArguments& arguments);
ExitCode run_render(const RenderArguments& arguments);
ExitCode run_dump(const DumpArguments& arguments);

struct QueryKind;
ExitCode run_query(const QueryKind& kind, const QueryArguments& arguments);

/// Prints it. Throws CommandError for bytes that are no sound scene.
void print_scene_info(const InfoArguments& arguments, std::span<const std::byte> bytes);

}  // namespace espalier::tools
