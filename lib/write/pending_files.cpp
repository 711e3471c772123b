#include "write/pending_files.hpp"

#include <utility>

#include "dem2buildings/error.hpp"
#include "write/existing_dataset.hpp"

namespace d2b {

PendingFiles::PendingFiles(Kind kind, const std::string& name, const std::filesystem::path& destination,
                           OldFiles old, Warnings& warnings)
    : kind_(kind), name_(name), old_(std::move(old)), warnings_(warnings) {
    staging_.emplace(name, destination);
}

void PendingFiles::check() {
    require_unchanged(name_, old_);
}

void PendingFiles::confirm() {
    const std::string doubt = staging_->confirm();
    if (!doubt.empty())
        warnings_.add("\"" + name_ +
                      "\" is written, but may be gone after a power failure: the disk does not confirm its "
                      "name (" +
                      doubt + ").");
}

void require_unchanged(const std::string& name, const OldFiles& old) {
    if (!old.files.empty() && stamp_of(old.files) != old.stamp)
        throw OutputError("\"" + name +
                          "\" has changed while this run was going on and is left alone; run again.");
}

}  // namespace d2b
