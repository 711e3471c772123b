#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/commit_list.hpp"
#include "write/staging.hpp"

namespace d2b {

/// Files at a destination that the result replaces.
struct OldFiles {
    std::vector<std::string> files;
    std::string stamp;  ///< changes when the files change
};

/// Local files that are written to a hidden folder next to their destination, then published by a CommitList.
class PendingFiles final : public PendingResult {
  public:
    /// @param name for messages @param warnings receives warnings, must outlive this object
    /// @throws OutputError if no folder can be created
    PendingFiles(Kind kind, const std::string& name, const std::filesystem::path& destination, OldFiles old,
                 Warnings& warnings);

    [[nodiscard]] Staging& staging() { return *staging_; }

    [[nodiscard]] Kind kind() const override { return kind_; }
    void check() override;
    void show() override { staging_->publish(old_.files); }
    void confirm() override;
    [[nodiscard]] std::string take_back() override { return staging_->take_back(); }
    void keep() override { staging_.reset(); }

  private:
    Kind kind_;
    std::string name_;
    OldFiles old_;
    Warnings& warnings_;
    std::optional<Staging> staging_;
};

/// @throws OutputError if the files of a destination have changed
void require_unchanged(const std::string& name, const OldFiles& old);

}  // namespace d2b
