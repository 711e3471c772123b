#include "pipeline/tiles/file_cache.hpp"

namespace d2b::tiles {

std::shared_ptr<const system::File> FileHandleCache::open(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    if (const auto known = places_.find(path.string()); known != places_.end()) {
        files_.splice(files_.begin(), files_, known->second);
        return known->second->file;
    }
    auto file = std::make_shared<const system::File>(path, system::File::Mode::read);
    if (!file->is_open())
        return file;
    file->disable_read_ahead();
    if (files_.size() >= most_) {
        places_.erase(files_.back().path);
        files_.pop_back();
    }
    files_.push_front({path.string(), file});
    places_[path.string()] = files_.begin();
    return file;
}

}  // namespace d2b::tiles
