// Files one after the other, in this process or in a child.
#pragma once

#include <functional>
#include <span>
#include <string>

#include <espalier/import.hpp>

namespace espalier::importer {

/// Reads the files in this order and appends them. `begin` is called with each path beforehand; it may be empty. Throws
/// ImportError, whose place names the file.
void import_files(std::span<const std::string> paths, const ImportOptions& options, ImportResult& imported,
                  const std::function<void(const std::string& path)>& begin = nullptr);

/// Imports the files in a child process (ImportOptions::separate_process). Throws ImportError for what is wrong with a
/// file, and (unsupported) where the system has no fork().
void import_in_child(std::span<const std::string> paths, const ImportOptions& options, ImportResult& imported);

/// Calls `import`, and stores in `imported` the status, and the reason in place of what it throws, unless that is
/// std::bad_alloc.
void import_or_refuse(ImportResult& imported, const std::function<void()>& import);

}  // namespace espalier::importer
