#include <import/assimp/steps.hpp>

#include <algorithm>

#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

/// Passes on what assimp reports, one line each, and keeps the warnings and errors about lost geometry.
class ReportStream : public Assimp::LogStream {
public:
    ReportStream(const ImportOptions& options, std::vector<std::string>* losses) : options_(options), losses_(losses) {}
    void write(const char* message) override {
        std::string line = message;
        while (line.ends_with('\n') || line.ends_with(' ')) line.pop_back();
        line = printable(line);
        if (losses_ != nullptr && reports_lost_geometry(line)) losses_->push_back(line);
        if (options_.log) options_.log(line);
    }

private:
    const ImportOptions& options_;
    std::vector<std::string>* losses_;
};

// All in lower case, with '|' between. assimp has no other way to state that it left something out.

/// A warning with one of these is about a loss; an error needs none.
constexpr std::string_view loss_words =
    "ignor|skip|unable|failed|cannot|unsupported|overflow|missing|not found|invalid|unresolved|not supported|"
    "zero indices|vertex index|face index|vertex setup|vertex reference|face record|number of|face count|"
    "vertex count|unexpected eof|unexpected end|indices per face|incomplete|mesh group|may have either|openings|"
    "unknown polygon|not enough";
/// These do not change where triangles are, unless a word of `geometry_words` stands beside them.
constexpr std::string_view look_words =
    "anim|binormal|bone|camera|color|lamp|light|material|normal|shad|skeleton|tangent|texture|uv|weight";
constexpr std::string_view geometry_words =
    "external file|face|geometr|instanced node|mesh|polygon|primitive|triang|vert";
/// Phrases of reports without a loss, though with the words above: about looks of vertices and faces, about parts of a
/// file that are no geometry, and about what is read all the same.
constexpr std::string_view harmless_words =
    "no material assigned|face material list|material index overflow|mapping type|source surface|tvertex|uv-face|"
    "uv channel|color channel|vertex color|vertex data channel|vertex normal|vmap/vmad|bone index overflow|"
    "material specified|chunk: chan|chunk: obrq|chunk: phan|chunk: rsob|chunk: shbx|span chunk|"
    "ifcpolyline|md5anim|md5camera|newer format version|"
    "property table";

/// Tests whether a line has one of the words, between which stands '|'.
bool contains_any(std::string_view line, std::string_view words) {
    while (!words.empty()) {
        const std::size_t length = std::min(words.find('|'), words.size());
        if (line.find(words.substr(0, length)) != std::string_view::npos) return true;
        words.remove_prefix(std::min(length + 1, words.size()));
    }
    return false;
}

}  // namespace

ImporterLog::ImporterLog(const ImportOptions& options) {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::Logger* logger = Assimp::DefaultLogger::get();  // which deletes the streams
    logger->attachStream(new ReportStream(options, &losses_), Assimp::Logger::Warn | Assimp::Logger::Err);
    if (options.log) logger->attachStream(new ReportStream(options, nullptr), Assimp::Logger::Info);
}

ImporterLog::~ImporterLog() { Assimp::DefaultLogger::kill(); }

bool reports_lost_geometry(std::string_view line) {
    const std::string lower = lower_case(line);
    if (!lower.starts_with("error") && !contains_any(lower, loss_words)) return false;
    if (contains_any(lower, harmless_words)) return false;
    return contains_any(lower, geometry_words) || !contains_any(lower, look_words);
}

}  // namespace espalier::importer
