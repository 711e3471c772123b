#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/commit_list.hpp"

namespace d2b::writing {

/// Renames files and undoes all renames in reverse order on destruction, unless keep() is called.
class RenameTransaction {
  public:
    RenameTransaction() = default;
    RenameTransaction(const RenameTransaction&) = delete;
    RenameTransaction& operator=(const RenameTransaction&) = delete;
    ~RenameTransaction();

    /// Never replaces a file. @throws std::system_error if `to` exists or the rename fails
    void move(const std::filesystem::path& from, const std::filesystem::path& to);
    /// Replaces the existing `to` atomically and keeps the old file: at `from` if the file system can
    /// exchange names, otherwise at `spare`, a path that does not exist. A folder then takes two steps.
    /// @throws std::system_error; both are then unchanged
    void replace(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::filesystem::path& spare);
    /// @return present paths of files that could not be restored
    [[nodiscard]] std::vector<std::filesystem::path> roll_back();
    void keep() { done_.clear(); }

  private:
    struct Rename {
        std::filesystem::path from;
        std::filesystem::path to;
        bool exchanged = false;  ///< old `to` is now at `from`
    };
    /// @return true if undone
    static bool undo(const Rename& move);

    std::vector<Rename> done_;
};

/// Calls fsync for a file or folder. @throws std::system_error
void sync_to_disk(const std::filesystem::path& path);

/// Hidden folder next to the destination, in which the dataset is written under its final name, because
/// drivers derive layer names, schemas and sidecar files from it. On destruction the folder is removed with
/// its contents.
///
/// Use it for local files only; files of virtual file systems have PendingVirtualFile.
class StagingFolder {
  public:
    /// @param name for messages @param destination local path @throws OutputError if no folder can be created
    StagingFolder(std::string name, std::filesystem::path destination);
    StagingFolder(const StagingFolder&) = delete;
    StagingFolder& operator=(const StagingFolder&) = delete;
    ~StagingFolder();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// Path that the driver writes to.
    [[nodiscard]] std::filesystem::path dataset() const { return folder_ / destination_.filename(); }

    /// Copies files of the destination into the folder, to be modified there. @throws OutputError
    void copy_in(const std::vector<std::string>& files);
    /// Records the present files as the result, because readers may add cache files later, which are not
    /// published. New files get the permissions of the files that they replace.
    void seal();
    /// Syncs the files to disk. @throws OutputError
    void sync() const;
    /// Moves the result to the destination and the old files (all files of the destination, none if it is
    /// new) to the hidden folder. One file or folder is replaced atomically; a set of files (Shapefile) one
    /// by one, the main file last, and restored if one fails. If restoring fails too, the old files stay in
    /// the hidden folder. @throws OutputError
    void publish(const std::vector<std::string>& old_files);
    /// @return reason why the new names could not be synced; "" on success
    [[nodiscard]] std::string confirm() const;
    /// Restores the old files after publish(). @return "" on success, otherwise a clause that says which
    /// files are in which folder
    [[nodiscard]] std::string roll_back();

  private:
    void publish_folder(bool replaces);
    void publish_files(const std::vector<std::string>& old_files);

    std::string name_;
    std::filesystem::path destination_;
    std::filesystem::path folder_;
    bool keeps_old_ = false;                     ///< true if old files could not be restored
    std::vector<std::filesystem::path> result_;  ///< file names, the main file last
    RenameTransaction moves_;                    ///< renames of publish()
};

/// Files at a destination that the result replaces.
struct ReplacedFiles {
    std::vector<std::string> files;
    std::string stamp;  ///< changes when the files change
};

/// Returns sizes and times of the files; differs after a change.
[[nodiscard]] std::string stamp_of(const std::vector<std::string>& files);

/// Local files that are written to a hidden folder next to their destination, then published by a CommitList.
class PendingFiles final : public PendingResult {
  public:
    /// @param name for messages @param warnings receives warnings, must outlive this object
    /// @throws OutputError if no folder can be created
    PendingFiles(Kind kind, const std::string& name, const std::filesystem::path& destination,
                 ReplacedFiles old, Warnings& warnings);

    [[nodiscard]] StagingFolder& staging() { return *staging_; }

    [[nodiscard]] Kind kind() const override { return kind_; }
    void check() override;
    void show() override { staging_->publish(old_.files); }
    void confirm() override;
    [[nodiscard]] std::string roll_back() override { return staging_->roll_back(); }
    void keep() override { staging_.reset(); }

  private:
    Kind kind_;
    std::string name_;
    ReplacedFiles old_;
    Warnings& warnings_;
    std::optional<StagingFolder> staging_;
};

/// @throws OutputError if the files of a destination have changed
void require_unchanged(const std::string& name, const ReplacedFiles& old);

/// Writes a text to a temporary file next to its destination and syncs it; a CommitList renames it. The file
/// appears whole or not at all, even if several processes write it. @throws OutputError
[[nodiscard]] std::unique_ptr<PendingResult> prepare_text_file(const std::filesystem::path& path,
                                                               const std::string& text);

/// Same, but publishes at once. @throws OutputError
void write_text_file(const std::filesystem::path& path, const std::string& text);

/// Base of sinks (FeatureSink, RasterSink, SurfaceSink) whose result is published by a CommitList: prepare()
/// writes everything that is still pending.
template <typename Sink>
class FileSink : public Sink {
  public:
    void prepare(CommitList& commit) override = 0;
    void finish() final {
        CommitList alone;
        this->prepare(alone);
        alone.publish();
    }
};

}  // namespace d2b::writing
