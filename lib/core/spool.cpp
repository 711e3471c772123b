#include "core/spool.hpp"

#include <algorithm>
#include <cstring>

namespace d2b {

std::uint64_t MemorySpool::append(std::span<const std::byte> bytes) {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t begin = size_;
    while (!bytes.empty()) {
        const std::size_t at = size_ % chunk;
        if (at == 0)
            chunks_.push_back(std::make_unique_for_overwrite<std::byte[]>(chunk));
        const std::size_t n = std::min(bytes.size(), chunk - at);
        std::memcpy(chunks_.back().get() + at, bytes.data(), n);
        size_ += n;
        bytes = bytes.subspan(n);
    }
    return begin;
}

void MemorySpool::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    const std::scoped_lock lock(mutex_);
    while (!bytes.empty()) {
        const std::size_t at = begin % chunk;
        const std::size_t n = std::min(bytes.size(), chunk - at);
        std::memcpy(bytes.data(), chunks_[begin / chunk].get() + at, n);
        begin += n;
        bytes = bytes.subspan(n);
    }
}

}  // namespace d2b
