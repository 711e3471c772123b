#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "dem2buildings/spool.hpp"

namespace d2b {

/// Writes values as they are in memory. Suitable for a spool, which only this run reads, and for files
/// exchanged by the same version of the program on machines with the same number formats; not a portable
/// format.
class ByteWriter {
  public:
    template <typename T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        put_bytes(std::as_bytes(std::span(&value, 1)));
    }
    /// Writes the number of values, then the values.
    template <typename T>
    void put_list(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        put(static_cast<std::uint64_t>(values.size()));
        put_bytes(std::as_bytes(std::span(values)));
    }
    /// Writes the number of bytes, then the bytes.
    void put_text(std::string_view text) {
        put(static_cast<std::uint64_t>(text.size()));
        put_bytes(std::as_bytes(std::span(text)));
    }
    void put_bytes(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    /// Writes 7 bits per byte, low bits first, so small values need one byte.
    void put_varint(std::uint64_t value) {
        for (; value >= more_follows; value >>= varint_bits)
            bytes_.push_back(static_cast<std::byte>(value | more_follows));
        bytes_.push_back(static_cast<std::byte>(value));
    }
    /// Maps numbers of small size, of either sign, to small ones, because these need few bytes (zigzag).
    void put_zigzag(std::int64_t value) {
        put_varint((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

    static constexpr std::uint64_t more_follows = 0x80;
    static constexpr int varint_bits = 7;

  private:
    std::vector<std::byte> bytes_;
};

/// A record that ends too early or holds an impossible value.
class CorruptRecord : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads values in the order in which ByteWriter wrote them. @throws CorruptRecord if too few bytes are left
class ByteReader {
  public:
    explicit ByteReader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
    ByteReader(const Spool& spool, SpoolEntry entry) : bytes_(entry.size) { spool.read(entry.begin, bytes_); }

    template <typename T>
    [[nodiscard]] T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value;
        std::memcpy(&value, take_bytes(sizeof(T)).data(), sizeof(T));
        return value;
    }
    [[nodiscard]] std::uint64_t take_varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < std::numeric_limits<std::uint64_t>::digits;
             shift += ByteWriter::varint_bits) {
            const auto byte = static_cast<std::uint64_t>(take_bytes(1).front());
            value |= (byte & (ByteWriter::more_follows - 1)) << shift;
            if (byte < ByteWriter::more_follows)
                return value;
        }
        throw CorruptRecord("a number has no end");
    }
    [[nodiscard]] std::int64_t take_zigzag() {
        const std::uint64_t value = take_varint();
        return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
    }
    /// @throws CorruptRecord also if the value exceeds `most`
    [[nodiscard]] std::int32_t take_varint(std::int32_t most) {
        const std::uint64_t value = take_varint();
        if (value > static_cast<std::uint64_t>(most))
            throw CorruptRecord("a number is larger than it may be");
        return static_cast<std::int32_t>(value);
    }
    /// Returns the number of elements that follow, each of at least `least_bytes` bytes.
    [[nodiscard]] std::size_t take_count(std::size_t least_bytes) {
        const auto count = take<std::uint64_t>();
        if (count > left() / least_bytes)
            throw CorruptRecord("it holds less than it announces");
        return static_cast<std::size_t>(count);
    }
    template <typename T>
    [[nodiscard]] std::vector<T> take_list() {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(take_count(sizeof(T)));
        const auto bytes = take_bytes(values.size() * sizeof(T));
        if (!values.empty())
            std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    [[nodiscard]] std::string take_text() {
        const std::vector<char> letters = take_list<char>();
        return {letters.begin(), letters.end()};
    }
    /// Returns a view that is valid as long as this reader.
    [[nodiscard]] std::span<const std::byte> take_bytes(std::size_t size) {
        if (size > left())
            throw CorruptRecord("it is truncated");
        const std::span<const std::byte> taken = std::span<const std::byte>(bytes_).subspan(at_, size);
        at_ += size;
        return taken;
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  private:
    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

[[nodiscard]] inline SpoolEntry append(Spool& spool, const ByteWriter& writer) {
    return {spool.append(writer.bytes()), writer.bytes().size()};
}

}  // namespace d2b
