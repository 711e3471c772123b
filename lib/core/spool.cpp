#include "dem2buildings/spool.hpp"

#include <algorithm>
#include <cstring>

namespace d2b {

std::uint64_t MemorySpool::append(std::span<const std::byte> bytes) {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t begin = size_;
    while (!bytes.empty()) {
        const std::size_t at = size_ % chunk;
        if (at == 0)
            chunks_.emplace_back().reserve(chunk);
        const std::size_t n = std::min(bytes.size(), chunk - at);
        chunks_.back().insert(chunks_.back().end(), bytes.begin(),
                              bytes.begin() + static_cast<std::ptrdiff_t>(n));
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
        std::memcpy(bytes.data(), chunks_[begin / chunk].data() + at, n);
        begin += n;
        bytes = bytes.subspan(n);
    }
}

}  // namespace d2b
