#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace d2b {

/// What a source or a sink warns of, each text once. While it is opened it tells at once; from then on, when
/// any thread may use it, texts wait until the run takes them, for warnings come from the caller's thread.
class Warnings {
  public:
    using Listener = std::function<void(const std::string&)>;

    /// @param listener told at once, from the thread that adds; empty: nobody listens
    explicit Warnings(Listener listener = {}) : listener_(std::move(listener)) {}

    /// From any thread.
    void add(const std::string& text);
    /// A line that another library says, as "<speaker>: <line>.". A damaged file may have one for every
    /// block: no more than a score of a speaker's are taken, and a last one says so.
    void add_quote(std::string_view speaker, const std::string& line);
    /// From now on texts wait for take().
    void hold();
    /// What has been added since the last time.
    [[nodiscard]] std::vector<std::string> take();

  private:
    void tell(const std::string& text);

    std::mutex mutex_;
    Listener listener_;
    bool held_ = false;
    std::vector<std::string> said_;     ///< all
    std::vector<std::string> waiting_;  ///< of these
};

}  // namespace d2b
