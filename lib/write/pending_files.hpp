#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/commit_list.hpp"
#include "write/staging.hpp"

namespace d2b {

/// What a destination consists of, which goes when a result comes in its place.
struct OldFiles {
    std::vector<std::string> files;
    std::string stamp;  ///< of them; changes when they do
};

/// Local files on their way: written in a hidden folder beside their place, and then put there whole by a
/// CommitList.
class PendingFiles final : public PendingResult {
  public:
    /// @param name for messages @param warnings get what is noticed, and must outlive this
    /// @throws OutputError where no folder can be made
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

/// @throws OutputError where the files of a destination are not what they were
void require_unchanged(const std::string& name, const OldFiles& old);

}  // namespace d2b
