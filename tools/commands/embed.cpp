// embed: one blob or scene in, one source file out, and its header.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <string_view>
#include <string>

#include <espalier/scene.hpp>

#include <import/base/numbers.hpp>
#include <import/platform/files.hpp>

#include "commands.hpp"
#include "files/blob_file.hpp"
#include "files/outputs.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"

namespace espalier::tools {

namespace {

enum class EmbeddingLanguage { c, assembler };

struct Embedding {
    std::string symbol;
    std::string section;
    unsigned alignment = 16;
    std::span<const std::byte> bytes;
};

// Of C23 and C++23 together, then what compilers define or programs need.
constexpr std::string_view taken_names =
    " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class"
    " co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue decltype"
    " default delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline"
    " int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public register"
    " reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct switch"
    " template this thread_local throw true try typedef typeid typename typeof typeof_unqual union unsigned using"
    " virtual void volatile wchar_t while xor xor_eq errno linux main unix ";

// A constant array, valid C99 and C++ for compilers that know GNU attributes. Without the first declaration a constant
// of C++ would be its file's own.
constexpr std::string_view c_form = R"(/* Made by espalier embed. */
#ifdef __cplusplus
extern "C" {
#endif

__attribute__((visibility("hidden"))) extern const unsigned char @symbol@[@size@];

__attribute__((section("@section@"), aligned(@alignment@)))
const unsigned char @symbol@[@size@] = {
@numbers@};

#ifdef __cplusplus
}
#endif
)";

// For ELF. The blob's name is looked up in the compiler's include folders when this is assembled, unless the macro is a
// string with the path. An object that does not say it goes with control-flow protection, or that it needs no
// executable stack, takes the one from the whole program and gives it the other.
constexpr std::string_view assembler_form = R"(/* Made by espalier embed. */
#ifndef __ELF__
#error "this is for ELF; let espalier embed write C for other object formats"
#endif
#ifdef __CET__
#include <cet.h>
#endif
#ifndef ESPALIER_BLOB_FILE
#define ESPALIER_BLOB_FILE @blob_name@
#endif
    .section @section@, "a", %progbits
    .balign @alignment@
    .global @symbol@
    .hidden @symbol@
    .type @symbol@, %object
    .size @symbol@, @size@
@symbol@:
    .incbin ESPALIER_BLOB_FILE, 0, @size@
    .section .note.GNU-stack, "", %progbits
)";

// Hidden, so that another shared library's blob of the same name is never taken for this one; the function, too, which
// is called where a compiler does not inline it.
constexpr std::string_view header_form = R"(/* Made by espalier embed. */
#ifndef ESPALIER_EMBEDDED_@symbol@
#define ESPALIER_EMBEDDED_@symbol@

#ifdef __cplusplus
#include <cstddef>
#if __cplusplus > 201703L
#include <span>
#endif
extern "C" {
#endif

#ifdef __ELF__
__attribute__((visibility("hidden")))
#endif
extern const unsigned char @symbol@[@size@];

#ifndef __cplusplus
enum { @symbol@_size = @size@@counts@ };
#else
}
constexpr std::size_t @symbol@_size = @size@@counts@;
#if __cplusplus > 201703L
#ifdef __ELF__
__attribute__((visibility("hidden")))
#endif
inline std::span<const std::byte> @symbol@_bytes() noexcept { return std::as_bytes(std::span(@symbol@)); }
#endif
#endif

#endif
)";

bool is_letter(char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z');
}

bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// The numbers, each line as long as fits.
std::string numbers(std::span<const std::byte> bytes) {
    constexpr std::size_t longest_line = 118;
    std::string result;
    result.reserve(bytes.size() * 4);
    std::size_t line_start = 0;
    for (const std::byte byte : bytes) {
        if (result.size() - line_start + 4 > longest_line) {
            result += '\n';
            line_start = result.size();
        }
        result += std::to_string(std::to_integer<unsigned>(byte));
        result += ',';
    }
    result += '\n';
    return result;
}

std::string in_quotes(const std::string& name) {
    std::string result = "\"";
    for (const char character : name) {
        if (character == '"' || character == '\\') result += '\\';
        result += character;
    }
    return result + '"';
}

/// The form with a word for each name between two @, of which one is its `own`; what is filled in is not looked at
/// again.
std::string filled(std::string_view form, const Embedding& embedding, std::string_view own, const std::string& word) {
    const std::pair<std::string_view, std::string> words[] = {{"symbol", embedding.symbol},
                                                              {"size", std::to_string(embedding.bytes.size())},
                                                              {"section", embedding.section},
                                                              {"alignment", std::to_string(embedding.alignment)},
                                                              {own, word}};
    std::string result;
    while (true) {
        const std::size_t start = form.find('@');
        result += form.substr(0, start);
        if (start == std::string_view::npos) return result;
        form.remove_prefix(start + 1);
        const std::string_view name = form.substr(0, form.find('@'));
        form.remove_prefix(name.size() + 1);
        result += std::find_if(std::begin(words), std::end(words), [&](const auto& each) {
                      return each.first == name;
                  })->second;
    }
}

/// Whether a C or C++ program can call a variable so: an identifier, not reserved, and neither a keyword of theirs nor
/// one of the words that compilers predefine.
bool is_variable_name(const std::string& name) {
    if (name.empty() || !is_letter(name.front()) || name.find("__") != std::string::npos) return false;
    const bool is_identifier = std::all_of(name.begin(), name.end(), [](char character) {
        return is_letter(character) || is_digit(character) || character == '_';
    });
    return is_identifier && taken_names.find(' ' + name + ' ') == std::string_view::npos;
}

/// Declares what either defines, its size, and of a scene how many meshes and tiles open_scene() needs room for.
std::string header_text(const Embedding& embedding) {
    // What the arrays of open_scene() are sized by; of a blob both are 0.
    const std::uint32_t meshes = mesh_count_of_scene(embedding.bytes), tiles = tile_count_of_scene(embedding.bytes);
    std::string counts;
    if (meshes != 0 || tiles != 0) {
        counts = ", " + embedding.symbol + "_mesh_count = " + std::to_string(meshes) + ", " + embedding.symbol +
                 "_tile_count = " + std::to_string(tiles);
    }
    return filled(header_form, embedding, "counts", counts);
}

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
        return is_letter(character) || is_digit(character) || character == '.' || character == '_';
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
    const std::string source = language == EmbeddingLanguage::c
                                   ? filled(c_form, embedding, "numbers", numbers(embedding.bytes))
                                   : filled(assembler_form, embedding, "blob_name", in_quotes(blob_name(arguments)));
    write_output_file(arguments.output, std::as_bytes(std::span(source)));
    console.say("wrote ", printable(arguments.output), ": ", embedding.symbol, ", ",
                counted(embedding.bytes.size(), "byte"), " in ", embedding.section, ", aligned to ",
                embedding.alignment);
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
