#include "tiles/recent_files.hpp"

#include <fcntl.h>

namespace d2b {

std::shared_ptr<const OpenFile> RecentFiles::open(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    if (const auto known = places_.find(path.native()); known != places_.end()) {
        files_.splice(files_.begin(), files_, known->second);
        return known->second->file;
    }
    auto file = std::make_shared<const OpenFile>(path, O_RDONLY);
    if (!file->is_open())
        return file;
    if (ahead_ == ReadAhead::none)
        file->expect_no_order();
    if (files_.size() >= most_) {
        places_.erase(files_.back().path);
        files_.pop_back();
    }
    files_.push_front({path.native(), file});
    places_[path.native()] = files_.begin();
    return file;
}

}  // namespace d2b
