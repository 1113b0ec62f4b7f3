// Opening without the proof. Nothing here looks behind the header, but for the number of copies.
#include <espalier/blob.hpp>
#include <runtime/open_header.hpp>

namespace espalier {

Status open_trusted_image(std::span<const std::byte> bytes, Blob& blob) noexcept {
    detail::make_empty(blob);
    Status status = detail::read_version_and_size(bytes.data(), bytes.size(), blob.data_);
    if (status == Status::ok) status = detail::read_header(blob.data_);
    if (status != Status::ok) detail::make_empty(blob);
    return status;
}

}  // namespace espalier
