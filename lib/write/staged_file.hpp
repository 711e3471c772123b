#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "write/file_target.hpp"
#include "write/ogr_util.hpp"
#include "write/staging.hpp"

namespace d2b::writing {

/// File in a virtual file system of GDAL, for example on a server, written under a temporary name and then
/// renamed.
class PendingVirtualFile final : public PendingResult {
  public:
    /// @param target for messages, must outlive this object @param replaces true if the file exists
    PendingVirtualFile(const WriteTarget& target, std::string path, bool replaces)
        : target_(target), path_(std::move(path)), replaces_(replaces) {}
    ~PendingVirtualFile() override;

    /// Temporary name.
    [[nodiscard]] std::string temporary_path() const { return path_ + ".part"; }

    [[nodiscard]] Kind kind() const override { return Kind::file; }
    void show() override;
    [[nodiscard]] std::string roll_back() override;
    void keep() override;

  private:
    [[nodiscard]] std::string backup_path() const { return path_ + ".old"; }
    void rename(const std::string& from, const std::string& to) const;

    const WriteTarget& target_;
    std::string path_;
    bool replaces_;
    bool shown_ = false;
};

/// File written next to the layers (raster, picture, surface) under a temporary name, then published by a
/// CommitList. Until then the destination is unchanged; on destruction the temporary file is removed.
class StagedFile {
  public:
    explicit StagedFile(FileDestination place);
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;
    ~StagedFile() = default;

    [[nodiscard]] const std::string& name() const { return place_.name; }
    /// True if an old file exists.
    [[nodiscard]] bool replaces() const { return !place_.old.files.empty(); }
    /// Used in messages.
    [[nodiscard]] const WriteTarget& target() const { return target_; }
    /// @return path of the file to write
    [[nodiscard]] std::string begin();
    /// Syncs the closed file and adds it to the commit. @throws OutputError
    void prepare(CommitList& commit);
    [[nodiscard]] std::vector<std::string> take_warnings() { return warnings_.take(); }

  private:
    FileDestination place_;
    Warnings warnings_;
    WriteTarget target_;
    std::optional<PendingFiles> local_;
    std::optional<PendingVirtualFile> virtual_;
};

}  // namespace d2b::writing
