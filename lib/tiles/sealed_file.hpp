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

#include "core/byte_record.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {

class OpenFile;
class RecentFiles;

/// Steps that exchange files, named as in messages.
enum class TileStep : std::uint32_t { find, join, draw, merge, write };
[[nodiscard]] std::string_view step_name(TileStep step);

/// Identity of a file between two steps: step, plan and tile.
struct Seal {
    TileStep step = TileStep::find;
    std::uint64_t plan = 0;  ///< digest of the plan
    std::uint32_t part = 0;  ///< tile; 0 if the step has a single file
};

/// Returns a digest that detects accidental damage, not attacks.
[[nodiscard]] std::uint64_t digest_of(std::span<const std::byte> bytes);

/// Writes a file under a temporary name, forces it to disk and renames it, so that it exists completely or
/// not at all.
/// @param body read at once @param tail read in pieces, see SealedFile @throws OutputError
void write_sealed(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
                  std::span<const std::byte> tail = {});

/// Batch of files that are forced to disk together, because forcing many small files one by one takes longer
/// than everything else.
class SealedFiles {
  public:
    /// @param folder of the files, which is created @throws OutputError
    explicit SealedFiles(std::filesystem::path folder);
    SealedFiles(const SealedFiles&) = delete;
    SealedFiles& operator=(const SealedFiles&) = delete;
    ~SealedFiles();

    /// Same as write_sealed(), but the system decides when data reach the disk.
    /// @param path within the folder @throws OutputError
    void write(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
               std::span<const std::byte> tail = {});
    /// Forces all files to disk. Only afterwards may other files refer to them. @throws OutputError
    void finish();

  private:
    std::filesystem::path folder_;
    int opened_;        ///< descriptor of the folder, opened first because syncfs() reports only later errors
    bool any_ = false;  ///< true if a file was written
};

/// Removes temporary files that a killed write_sealed() left in a folder. Harmless for a process that is
/// still writing a file which another one has also written.
void remove_unfinished(const std::filesystem::path& folder);

/// Returns true if the file exists, has this plan and version, and is complete.
[[nodiscard]] bool is_sealed(const std::filesystem::path& path, const Seal& seal);

/// File written by write_sealed().
class SealedFile {
  public:
    /// @param recent cache of open files, which must outlive this object; null opens the file for each piece
    /// @throws InputError if it does not exist, is truncated or damaged, or has another step, plan or version
    SealedFile(std::filesystem::path path, const Seal& seal, RecentFiles* recent = nullptr);

    /// Moves the body out. Call once.
    [[nodiscard]] ByteReader body() { return ByteReader(std::move(body_)); }
    /// Reads part of the payload. @throws InputError
    [[nodiscard]] std::vector<std::byte> tail(std::uint64_t begin, std::uint64_t size) const;
    [[nodiscard]] std::uint64_t tail_size() const { return tail_size_; }
    /// Formats "'work/find/3' is damaged: it ends too soon; delete it and run 'find' of tile 3 again."
    [[nodiscard]] std::string damaged(const std::string& what) const;

  private:
    [[nodiscard]] std::shared_ptr<const OpenFile> open() const;

    std::filesystem::path path_;
    Seal seal_;
    RecentFiles* recent_;
    std::vector<std::byte> body_;
    std::uint64_t tail_begin_ = 0;
    std::uint64_t tail_size_ = 0;
};

/// Calls load(reader) with the body of a file, all of which it must consume.
/// @throws InputError if the content is invalid
template <typename Load>
auto load_body(SealedFile& file, const Load& load) {
    try {
        ByteReader reader = file.body();
        auto loaded = load(reader);
        if (reader.left() > 0)
            throw BrokenRecord("more follows than it says");
        return loaded;
    } catch (const BrokenRecord& broken) {
        throw InputError(file.damaged(broken.what()));
    }
}

}  // namespace d2b
