// Opening without the proof. Nothing here reads behind the header, except the number of duplicate references.
#include <espalier/blob.hpp>
#include <runtime/open/header.hpp>

namespace espalier {

Blob open_unchecked(std::span<const std::byte> bytes) noexcept {
    Blob blob;
    OpenStatus status = detail::read_version_and_size(bytes.data(), bytes.size(), blob.data_);
    if (status == OpenStatus::ok) status = detail::read_header(blob.data_);
    if (status != OpenStatus::ok) detail::refuse(blob.data_, status);
    return blob;
}

}  // namespace espalier
