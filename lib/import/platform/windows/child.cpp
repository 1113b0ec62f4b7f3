#include <import/platform/child.hpp>

#include <cerrno>

namespace espalier::importer {

ChildProcess::ChildProcess(const std::function<int(std::FILE* to_parent)>&) : error_(ENOSYS) {}

ChildProcess::~ChildProcess() = default;

std::size_t ChildProcess::read(std::span<std::byte>) { return 0; }

ChildEnd ChildProcess::wait() { return {}; }

}  // namespace espalier::importer
