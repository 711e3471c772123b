#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "write/file_moves.hpp"

namespace d2b {

/// Hidden folder next to the destination, in which the dataset is written under its final name, because
/// drivers derive layer names, schemas and sidecar files from it. On destruction the folder is removed with
/// its contents.
///
/// Use it for local files only; files of virtual file systems have PendingVirtualFile.
class Staging {
  public:
    /// @param name for messages @param destination local path @throws OutputError if no folder can be created
    Staging(std::string name, std::filesystem::path destination);
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;
    ~Staging();

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
    [[nodiscard]] std::string take_back();

  private:
    void publish_folder(bool replaces);
    void publish_files(const std::vector<std::string>& old_files);

    std::string name_;
    std::filesystem::path destination_;
    std::filesystem::path folder_;
    bool keeps_old_ = false;                     ///< true if old files could not be restored
    std::vector<std::filesystem::path> result_;  ///< file names, the main file last
    FileMoves moves_;                            ///< renames of publish()
};

}  // namespace d2b
