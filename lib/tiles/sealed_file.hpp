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

/// The steps whose files others read, as messages call them.
enum class TileStep : std::uint32_t { find, join, draw, merge, write };
[[nodiscard]] std::string_view step_name(TileStep step);

/// What a file between two steps is: it is of one step of one plan.
struct Seal {
    TileStep step = TileStep::find;
    std::uint64_t plan = 0;  ///< digest of the plan
    std::uint32_t part = 0;  ///< the tile; 0 where there is one file of the step
};

/// A digest of bytes that tells accidents, not attacks.
[[nodiscard]] std::uint64_t digest_of(std::span<const std::byte> bytes);

/// Writes a file under another name, forces it to the disk and renames it: it is there whole or not at all.
/// @param body is read at once @param tail is read in pieces, see SealedFile @throws OutputError
void write_sealed(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
                  std::span<const std::byte> tail = {});

/// Files that count together: where they are many, forcing each to the disk by itself takes longer than all
/// else.
class SealedFiles {
  public:
    /// @param folder that they are in, which is made @throws OutputError
    explicit SealedFiles(std::filesystem::path folder);
    SealedFiles(const SealedFiles&) = delete;
    SealedFiles& operator=(const SealedFiles&) = delete;
    ~SealedFiles();

    /// As write_sealed(), but what comes to the disk when is left to the system.
    /// @param path within the folder @throws OutputError
    void write(const std::filesystem::path& path, const Seal& seal, std::span<const std::byte> body,
               std::span<const std::byte> tail = {});
    /// Forces all of them to the disk: what says that they are there may be written then. @throws OutputError
    void finish();

  private:
    std::filesystem::path folder_;
    int opened_;        ///< the folder, before anything could go wrong with what is in it
    bool any_ = false;  ///< has been written
};

/// Removes what write_sealed() has left in a folder where it was killed. A process that still writes a file
/// which another one has written as well loses nothing by it.
void remove_unfinished(const std::filesystem::path& folder);

/// Whether the file is there, of this plan and version, and as long as it has to be.
[[nodiscard]] bool is_sealed(const std::filesystem::path& path, const Seal& seal);

/// A file that write_sealed() wrote.
class SealedFile {
  public:
    /// @param recent keeps it open among others, and must outlive this; null: it is opened for each piece
    /// @throws InputError where there is none, it is cut short or damaged, or of another step, plan or
    /// version
    SealedFile(std::filesystem::path path, const Seal& seal, RecentFiles* recent = nullptr);

    /// Takes the body. Call once.
    [[nodiscard]] ByteReader body() { return ByteReader(std::move(body_)); }
    /// @throws InputError
    [[nodiscard]] std::vector<std::byte> tail(std::uint64_t begin, std::uint64_t size) const;
    [[nodiscard]] std::uint64_t tail_size() const { return tail_size_; }
    /// "'work/find/3' is damaged: it ends too soon; delete it and run 'find' of tile 3 again."
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

/// Calls load(reader) with the body of a file, all of which it has to take.
/// @throws InputError where the file is not what it should be
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
