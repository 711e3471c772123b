#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "write/file_moves.hpp"

namespace d2b {

/// A hidden folder beside the destination, in which the dataset is written under its own name: drivers take
/// layer names, schemas and sidecar files from the name. Gone, with all that is in it, when this object is.
class Staging {
  public:
    /// @param name for messages @param destination a local path @throws OutputError where no folder can be
    /// made
    Staging(std::string name, std::filesystem::path destination);
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;
    ~Staging();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// Where the driver writes.
    [[nodiscard]] std::filesystem::path dataset() const { return folder_ / destination_.filename(); }

    /// Brings files of the destination into the folder, to be changed there. @throws OutputError
    void copy_in(const std::vector<std::string>& files);
    /// Remembers what is there as the result: what turns up later (caches of readers) is not published. What
    /// replaces a file becomes as readable as that file.
    void seal();
    /// Forces the files to the disk. @throws OutputError
    void sync() const;
    /// Puts the result in the place of the old files, all that the destination consists of (none where it is
    /// new), which the hidden folder keeps from now on. One file and a folder change in one step; a set of
    /// files (Shapefile) one after the other, the main file last, and back again where one fails. Where not
    /// even that goes, the old files stay in the hidden folder. @throws OutputError
    void publish(const std::vector<std::string>& old_files);
    /// @return why the disk does not confirm the new names; "" where it does
    [[nodiscard]] std::string confirm() const;
    /// After publish(): puts the old files back. @return where that fails a clause that says what lies where
    [[nodiscard]] std::string take_back();

  private:
    void publish_folder(bool replaces);
    void publish_files(const std::vector<std::string>& old_files);

    std::string name_;
    std::filesystem::path destination_;
    std::filesystem::path folder_;
    bool keeps_old_ = false;                     ///< files that could not be brought back
    std::vector<std::filesystem::path> result_;  ///< file names, the main one last
    FileMoves moves_;                            ///< of publish()
};

}  // namespace d2b
