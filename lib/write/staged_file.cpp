#include "write/staged_file.hpp"

#include <cpl_vsi.h>

#include "read/gdal_messages.hpp"

namespace d2b::writing {

PendingVirtualFile::~PendingVirtualFile() {
    const reading::GdalMessages quiet;
    if (!shown_)
        VSIUnlink(temporary_path().c_str());
}

void PendingVirtualFile::rename(const std::string& from, const std::string& to) const {
    OgrCall call(target_);
    const bool renamed = VSIRename(from.c_str(), to.c_str()) == 0;
    call.check(renamed, "renaming the finished result");
}

void PendingVirtualFile::show() {
    if (replaces_)
        rename(path_, backup_path());
    try {
        rename(temporary_path(), path_);
    } catch (...) {
        const reading::GdalMessages quiet;
        if (replaces_)
            VSIRename(backup_path().c_str(), path_.c_str());
        throw;
    }
    shown_ = true;
}

std::string PendingVirtualFile::roll_back() {
    const reading::GdalMessages quiet;
    const bool done =
        replaces_ ? VSIRename(backup_path().c_str(), path_.c_str()) == 0 : VSIUnlink(path_.c_str()) == 0;
    return done ? "" : "\"" + target_.name + "\" has been written already";
}

void PendingVirtualFile::keep() {
    const reading::GdalMessages quiet;
    if (replaces_)
        VSIUnlink(backup_path().c_str());
}

StagedFile::StagedFile(FileDestination place)
    : place_(std::move(place)), target_{.name = place_.name, .hidden_folder = "", .warnings = &warnings_} {
    warnings_.hold();
}

std::string StagedFile::begin() {
    if (!place_.local)
        return virtual_.emplace(target_, place_.path, replaces()).temporary_path();
    local_.emplace(PendingResult::Kind::file, place_.name, place_.path, place_.old, warnings_);
    target_.hidden_folder = local_->staging().folder().string() + "/";
    return local_->staging().dataset().string();
}

void StagedFile::prepare(CommitList& commit) {
    if (virtual_) {
        commit.add(*virtual_);
        return;
    }
    local_->staging().seal();
    local_->staging().sync();
    commit.add(*local_);
}

}  // namespace d2b::writing
