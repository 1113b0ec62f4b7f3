#include "log.hpp"

#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>

#include "base/numbers.hpp"
#include "importer_reports.hpp"

namespace espalier::tools {

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

}  // namespace

ImporterLog::ImporterLog(const ImportOptions& options) {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::Logger* logger = Assimp::DefaultLogger::get();  // which deletes the streams
    logger->attachStream(new ReportStream(options, &losses_), Assimp::Logger::Warn | Assimp::Logger::Err);
    if (options.log) logger->attachStream(new ReportStream(options, nullptr), Assimp::Logger::Info);
}

ImporterLog::~ImporterLog() { Assimp::DefaultLogger::kill(); }

}  // namespace espalier::tools
