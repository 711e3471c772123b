#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "dem2buildings/spool.hpp"

namespace d2b {

/// Values one after the other, as they are in memory: for a spool, which nothing but this run reads.
class ByteWriter {
  public:
    template <typename T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        put_bytes(std::as_bytes(std::span(&value, 1)));
    }
    void put_bytes(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

/// Takes the same values in the same order.
class ByteReader {
  public:
    ByteReader(const Spool& spool, SpoolEntry entry) : bytes_(entry.size) { spool.read(entry.begin, bytes_); }

    template <typename T>
    [[nodiscard]] T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value;
        std::memcpy(&value, take_bytes(sizeof(T)).data(), sizeof(T));
        return value;
    }
    /// Valid as long as this is.
    [[nodiscard]] std::span<const std::byte> take_bytes(std::size_t size) {
        const std::span<const std::byte> taken = std::span<const std::byte>(bytes_).subspan(at_, size);
        at_ += size;
        return taken;
    }

  private:
    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

[[nodiscard]] inline SpoolEntry append(Spool& spool, const ByteWriter& writer) {
    return {spool.append(writer.bytes()), writer.bytes().size()};
}

}  // namespace d2b
