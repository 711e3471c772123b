#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "write/ogr_call.hpp"
#include "write/pending_files.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A file in one of GDAL's virtual file systems, on a server say, on its way: written beside its place under
/// another name.
class PendingVirtualFile final : public PendingResult {
  public:
    /// @param target for messages, must outlive this @param replaces whether there is one in its place
    PendingVirtualFile(const WriteTarget& target, std::string path, bool replaces)
        : target_(target), path_(std::move(path)), replaces_(replaces) {}
    ~PendingVirtualFile() override;

    /// Where it is written.
    [[nodiscard]] std::string beside() const { return path_ + ".part"; }

    [[nodiscard]] Kind kind() const override { return Kind::file; }
    void show() override;
    [[nodiscard]] std::string take_back() override;
    void keep() override;

  private:
    [[nodiscard]] std::string old() const { return path_ + ".old"; }
    void rename(const std::string& from, const std::string& to) const;

    const WriteTarget& target_;
    std::string path_;
    bool replaces_;
    bool shown_ = false;
};

/// A file beside the layers on its way: written beside its place, and put there whole by a CommitList. Until
/// then the place stays as it was, and nothing is left beside it where this goes.
class StagedRaster {
  public:
    explicit StagedRaster(RasterPlace place);
    StagedRaster(const StagedRaster&) = delete;
    StagedRaster& operator=(const StagedRaster&) = delete;
    ~StagedRaster() = default;

    [[nodiscard]] const std::string& name() const { return place_.name; }
    /// Whether there is an old one in its place.
    [[nodiscard]] bool replaces() const { return !place_.old_files.empty(); }
    /// For messages about it.
    [[nodiscard]] const WriteTarget& target() const { return target_; }
    /// @return the path of the file to write
    [[nodiscard]] std::string begin();
    /// The file is closed: forces it to the disk and adds it. @throws OutputError
    void prepare(CommitList& commit);
    [[nodiscard]] std::vector<std::string> take_warnings() { return warnings_.take(); }

  private:
    RasterPlace place_;
    Warnings warnings_;
    WriteTarget target_;
    std::optional<PendingFiles> local_;
    std::optional<PendingVirtualFile> virtual_;
};

}  // namespace d2b
