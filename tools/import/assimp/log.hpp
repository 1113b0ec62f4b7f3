// What assimp reports while it reads a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// While it lives, assimp's reports are read. One at a time.
class ImporterLog {
public:
    explicit ImporterLog(const ImportOptions& options);
    ~ImporterLog();
    ImporterLog(const ImporterLog&) = delete;
    ImporterLog& operator=(const ImporterLog&) = delete;

    /// Returns the reports of lost geometry.
    [[nodiscard]] const std::vector<std::string>& losses() const { return losses_; }

private:
    std::vector<std::string> losses_;
};

/// Returns true for an error of assimp, and for a warning that something was left out, unless it is only about looks,
/// lights, cameras or motion. `line` begins with its severity, as assimp writes it.
bool reports_lost_geometry(std::string_view line);

}  // namespace espalier::tools
