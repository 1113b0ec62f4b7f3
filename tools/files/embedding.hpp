// A blob as source text: bytes that a linker places into read-only memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace espalier::tools {

enum class EmbeddingLanguage { c, assembler };

struct Embedding {
    std::string symbol;
    std::string section;
    unsigned alignment = 16;
    std::span<const std::byte> bytes;
};

/// Whether a C or C++ program can call a variable so: an identifier, not reserved, and neither a keyword of theirs nor
/// one of the words that compilers predefine.
bool is_variable_name(const std::string& name);

/// A constant array, valid C99 and C++ for compilers that know GNU attributes.
std::string c_text(const Embedding& embedding);

/// For ELF. `blob_name` is looked up in the compiler's include folders when this is assembled, unless the macro
/// ESPALIER_BLOB_FILE is a string with the path.
std::string assembler_text(const Embedding& embedding, const std::string& blob_name);

/// Declares what either defines, its size, and of a scene how many meshes and tiles open_scene() needs room for.
std::string header_text(const Embedding& embedding);

}  // namespace espalier::tools
