#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/byte_record.hpp"
#include "tiles/sealed_file.hpp"

namespace d2b {

/// Tail of a file in blocks, each with its own digest.
class TailBlocks {
  public:
    struct Block {
        std::uint64_t size = 0;
        std::uint64_t digest = 0;
    };
    /// Allocates memory once, if the size is known.
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
    /// Adds a block; ignores empty ones.
    void add(const ByteWriter& block);
    [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::vector<Block> blocks_;
    std::vector<std::byte> bytes_;
};

/// Reads a block and verifies its digest. @param begin of the block in the payload @throws InputError if it
/// is damaged
[[nodiscard]] ByteReader read_block(const SealedFile& file, std::uint64_t begin,
                                    const TailBlocks::Block& block);

}  // namespace d2b
