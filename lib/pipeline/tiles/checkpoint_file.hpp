#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/byte_stream.hpp"
#include "core/system/file.hpp"
#include "core/system/paths.hpp"
#include "dem2buildings/error.hpp"

namespace d2b::tiles {

class FileHandleCache;

/// Steps that exchange files, named as in messages.
enum class TileStep : std::uint32_t { find, join, draw, merge, write, plan };
[[nodiscard]] std::string_view step_name(TileStep step);

/// File between two steps, and the identity that it has to have.
struct Checkpoint {
    std::filesystem::path path;
    TileStep step = TileStep::find;  ///< that writes it
    std::uint64_t plan = 0;          ///< digest of the plan
    std::uint32_t part = 0;          ///< tile; 0 if the step has a single file
};

/// Returns a digest that detects accidental damage, not attacks.
[[nodiscard]] std::uint64_t digest_of(std::span<const std::byte> bytes);

/// Writes a file under a temporary name, forces it to disk and renames it, so that it exists completely or
/// not at all.
/// @param body read at once @param payload read in pieces, see CheckpointFile @throws OutputError
void write_checkpoint(const Checkpoint& place, std::span<const std::byte> body,
                      std::span<const std::byte> payload = {});

/// Batch of files that are forced to disk together, because forcing many small files one by one takes longer
/// than everything else.
class CheckpointBatch {
  public:
    /// @param folder of the files, which is created @throws OutputError
    explicit CheckpointBatch(std::filesystem::path folder);
    CheckpointBatch(const CheckpointBatch&) = delete;
    CheckpointBatch& operator=(const CheckpointBatch&) = delete;
    ~CheckpointBatch() = default;

    /// Same as write_checkpoint(), but the system decides when data reach the disk.
    /// @param place within the folder @throws OutputError
    void write(const Checkpoint& place, std::span<const std::byte> body,
               std::span<const std::byte> payload = {});
    /// Forces all files to disk. Only afterwards may other files refer to them. @throws OutputError
    void finish();

  private:
    std::filesystem::path folder_;
    system::OpenFolder opened_;  ///< opened first because only later errors are reported
    bool any_ = false;           ///< true if a file was written
};

/// Removes temporary files that a killed write_checkpoint() left in a folder. Harmless for a process that is
/// still writing a file which another one has also written.
void remove_unfinished(const std::filesystem::path& folder);

/// Returns true if the file exists, has this plan and version, and is complete.
[[nodiscard]] bool checkpoint_exists(const Checkpoint& place);

/// File written by write_checkpoint().
class CheckpointFile {
  public:
    /// @param recent cache of open files, which must outlive this object; null opens the file for each piece
    /// @throws InputError if it does not exist, is truncated or damaged, or has another step, plan or version
    explicit CheckpointFile(Checkpoint place, FileHandleCache* cache = nullptr);

    /// Moves the body out. Call once.
    [[nodiscard]] ByteReader body() { return ByteReader(std::move(body_)); }
    /// Reads part of the payload. @throws InputError
    [[nodiscard]] std::vector<std::byte> payload(std::uint64_t begin, std::uint64_t size) const;
    [[nodiscard]] std::uint64_t payload_size() const { return payload_size_; }
    /// Formats "'work/find/3' is damaged: it is truncated; delete it and run 'find' of tile 3 again."
    [[nodiscard]] std::string damaged(const std::string& what) const;

  private:
    [[nodiscard]] std::shared_ptr<const system::File> open() const;

    Checkpoint place_;
    FileHandleCache* cache_;
    std::vector<std::byte> body_;
    std::uint64_t payload_begin_ = 0;
    std::uint64_t payload_size_ = 0;
};

/// Calls load(reader) with the body of a file, all of which it must consume.
/// @throws InputError if the content is invalid
template <typename Load>
auto load_body(CheckpointFile& file, const Load& load) {
    try {
        ByteReader reader = file.body();
        auto loaded = load(reader);
        if (reader.left() > 0)
            throw CorruptRecord("more follows than it says");
        return loaded;
    } catch (const CorruptRecord& broken) {
        throw InputError(file.damaged(broken.what()));
    }
}

/// Tail of a file in blocks, each with its own digest.
class PayloadBlocks {
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
[[nodiscard]] ByteReader read_block(const CheckpointFile& file, std::uint64_t begin,
                                    const PayloadBlocks::Block& block);

}  // namespace d2b::tiles
