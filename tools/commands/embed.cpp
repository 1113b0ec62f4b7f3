// embed: one blob or scene in, one source file out, and its header.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "files/embedding.hpp"
#include "files/outputs.hpp"
#include "platform/files.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

namespace {

constexpr unsigned largest_alignment = 65536;
/// What C's enumerators hold, and more than compilers of 32-bit machines take.
constexpr std::size_t most_bytes = std::numeric_limits<std::int32_t>::max();

EmbeddingLanguage language_of(const std::string& output) {
    const std::string ending = text_of(path_of(output).extension());
    if (ending == ".c" || ending == ".cpp") return EmbeddingLanguage::c;
    if (ending == ".S") return EmbeddingLanguage::assembler;
    throw_error(ExitCode::usage, "-o '", printable(output), "': its ending selects the language: .c or .cpp ",
                "for an array, .S for assembler.");
}

std::string symbol_of(const EmbedArguments& arguments) {
    std::string symbol = arguments.symbol.empty() ? text_of(path_of(arguments.output).stem()) : arguments.symbol;
    if (is_variable_name(symbol)) return symbol;
    throw_error(ExitCode::usage, "'", printable(symbol),
                "' cannot name a variable in C and C++. Give --symbol a name of ",
                "letters, digits and single underscores, that starts with a letter and is no keyword.");
}

std::string section_of(const EmbedArguments& arguments, const std::string& symbol) {
    if (arguments.section.empty()) return ".rodata." + symbol;
    const bool is_plain = std::all_of(arguments.section.begin(), arguments.section.end(), [](char character) {
        return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
               (character >= '0' && character <= '9') || character == '.' || character == '_';
    });
    if (is_plain) return arguments.section;
    throw_error(ExitCode::usage, "--section '", printable(arguments.section),
                "': a section's name has letters, digits, dots and underscores.");
}

unsigned alignment_of(const EmbedArguments& arguments) {
    const unsigned alignment = arguments.alignment;
    if (alignment != 0 && alignment <= largest_alignment && (alignment & (alignment - 1)) == 0) return alignment;
    throw_error(ExitCode::usage, "--alignment ", alignment, ": an alignment is a power of two up to ",
                largest_alignment, '.');
}

/// As the assembler finds it in an include folder.
std::string blob_name(const EmbedArguments& arguments) {
    std::string name = text_of(path_of(arguments.blob).filename());
    if (name == printable(name)) return name;
    throw_error(ExitCode::usage, "'", printable(name), "': a name with control characters cannot stand in ",
                "assembler. Rename the blob, or write C.");
}

void refuse_to_meet_sources(const EmbedArguments& arguments) {
    const NamedOutput outputs[] = {{"-o", arguments.output}, {"--header", arguments.header}};
    refuse_to_overwrite_input(outputs, arguments.blob);
    refuse_one_file_for_two(outputs);
    require_writable(outputs);
    if (arguments.json) refuse_standard_output(outputs);
}

}  // namespace

ExitCode run_embed(const EmbedArguments& arguments) {
    const Console console(arguments.quiet);
    refuse_to_meet_sources(arguments);
    const EmbeddingLanguage language = language_of(arguments.output);
    Embedding embedding;
    embedding.symbol = symbol_of(arguments);
    embedding.section = section_of(arguments, embedding.symbol);
    embedding.alignment = alignment_of(arguments);

    const AssetFile file(arguments.blob);
    file.require_open();
    if (file.bytes.size() > most_bytes) {
        throw_error(ExitCode::unsupported, "'", printable(arguments.blob), "' has more than ", most_bytes,
                    " bytes, too many to link. Map it from a file.");
    }
    embedding.bytes = file.bytes;
    if (!arguments.header.empty()) {
        const std::string header = header_text(embedding);
        write_output_file_if_changed(arguments.header, std::as_bytes(std::span(header)));
    }
    const std::string source =
        language == EmbeddingLanguage::c ? c_text(embedding) : assembler_text(embedding, blob_name(arguments));
    write_output_file(arguments.output, std::as_bytes(std::span(source)));
    console.say(text("wrote ", printable(arguments.output), ": ", embedding.symbol, ", ",
                     counted(embedding.bytes.size(), "byte"), " in ", embedding.section, ", aligned to ",
                     embedding.alignment));
    if (arguments.json) {
        Json document = json_document();
        document["output"] = arguments.output;
        document["header"] = arguments.header.empty() ? Json(nullptr) : Json(arguments.header);
        document["symbol"] = embedding.symbol;
        document["section"] = embedding.section;
        document["alignment"] = embedding.alignment;
        document["bytes"] = embedding.bytes.size();
        print_json(document);
    }
    return ExitCode::ok;
}

}  // namespace espalier::tools
