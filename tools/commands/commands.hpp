// The verbs of the command, one file each. Each returns the exit status, or throws CommandError. Warnings are added to
// the list as they are found.
#pragma once

#include <cstddef>
#include <vector>

#include "base/exit_code.hpp"
#include "base/verb_arguments.hpp"

namespace espalier::tools {

ExitCode run_bake(const BakeArguments& arguments, std::vector<Warning>& warnings);
ExitCode run_refit(const RefitArguments& arguments, std::vector<Warning>& warnings);
ExitCode run_embed(const EmbedArguments& arguments);
ExitCode run_trade(const TradeArguments& arguments, std::vector<Warning>& warnings);
ExitCode run_info(const InfoArguments& arguments);
ExitCode run_verify(const VerifyArguments& arguments, std::vector<Warning>& warnings);
ExitCode run_render(const RenderArguments& arguments, std::vector<Warning>& warnings);
ExitCode run_dump(const DumpArguments& arguments);

/// Prints a line of the table of `info`, whose value has these parts.
void print_value(const std::string& name, const std::string& value);
template <class... Parts>
void print_line(const std::string& name, const Parts&... parts) {
    print_value(name, text(parts...));
}

/// A part of a file; its line of that table may state its bytes for each triangle.
struct NamedBytes {
    const char* name;
    std::size_t bytes;
};
void print_section(const NamedBytes& section, const std::string& per_triangle = {});

/// Prints what is inside a scene.
struct AssetFile;
void print_scene_info(const InfoArguments& arguments, const AssetFile& file);

}  // namespace espalier::tools
