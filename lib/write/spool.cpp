#include "dem2buildings/spool.hpp"

#include <algorithm>
#include <utility>

#include "read/temporary_file.hpp"

namespace d2b {
namespace {

/// Reserves memory at once instead of doubling, because unused pages cost nothing, while each doubling copies
/// all bytes.
void grow(std::vector<std::byte>& memory, std::size_t size, std::size_t most) {
    constexpr std::size_t small = std::size_t{1} << 20;
    constexpr std::size_t large = std::size_t{64} << 20;
    if (size > memory.capacity() && size > small)
        memory.reserve(std::max(size, std::min(most, large) + small));
}

}  // namespace

FileSpool::FileSpool(std::string folder, std::size_t in_memory)
    : folder_(std::move(folder)), most_in_memory_(in_memory) {}

FileSpool::~FileSpool() = default;

std::uint64_t FileSpool::in_file() const {
    return file_ ? file_->size() : 0;
}

std::uint64_t FileSpool::append(std::span<const std::byte> bytes) {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t begin = in_file() + memory_.size();
    const std::size_t most = file_ ? bytes_per_write : most_in_memory_;
    if (memory_.size() + bytes.size() <= most)
        grow(memory_, memory_.size() + bytes.size(), most);
    memory_.insert(memory_.end(), bytes.begin(), bytes.end());
    if (memory_.size() > most)
        flush();
    return begin;
}

void FileSpool::flush() {
    if (!file_)
        file_ = std::make_unique<reading::TemporaryFile>(folder_, "The finished part of the result",
                                                         reading::FileName::none);
    file_->append(memory_);
    if (memory_.capacity() > 2 * bytes_per_write)
        memory_ = std::vector<std::byte>();  // {} would keep the capacity
    memory_.clear();
}

void FileSpool::read(std::uint64_t begin, std::span<std::byte> bytes) const {
    {
        const std::scoped_lock lock(mutex_);
        if (begin >= in_file()) {
            std::copy_n(memory_.begin() + static_cast<std::ptrdiff_t>(begin - in_file()), bytes.size(),
                        bytes.begin());
            return;
        }
    }
    // Needs no lock, because a piece appended at once is in the file as a whole, and the file only grows.
    file_->read(begin, bytes);
}

}  // namespace d2b
