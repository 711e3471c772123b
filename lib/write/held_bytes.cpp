#include "write/held_bytes.hpp"

#include <span>

namespace d2b {
namespace {

constexpr std::size_t bytes_an_entry = std::size_t{1} << 20;

}  // namespace

void HeldBytes::add(std::string_view bytes) {
    waiting_ += bytes;
    size_ += bytes.size();
    if (waiting_.size() >= bytes_an_entry)
        put_aside();
}

void HeldBytes::put_aside() {
    const std::uint64_t begin = spool_.append(std::as_bytes(std::span(waiting_)));
    entries_.push_back({begin, waiting_.size()});
    waiting_.clear();
}

void HeldBytes::write_to(SurfaceFile& file) {
    std::string bytes;
    for (const SpoolEntry& entry : entries_) {
        bytes.resize(entry.size);
        spool_.read(entry.begin, std::as_writable_bytes(std::span(bytes)));
        file.write(bytes);
    }
    file.write(waiting_);
}

}  // namespace d2b
