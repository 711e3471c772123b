#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace d2b {

/// Warnings of a source or sink, each text once. While it is being opened they are reported immediately.
/// After hold(), when any thread may add some, they are kept until the run takes them, because warnings are
/// reported from the caller's thread.
class Warnings {
  public:
    using Listener = std::function<void(const std::string&)>;

    /// @param listener called immediately, from the thread that adds; may be empty
    explicit Warnings(Listener listener = {}) : listener_(std::move(listener)) {}

    /// Thread-safe.
    void add(const std::string& text);
    /// Adds a message of another library as "<speaker>: <line>.". Limited to 20 per speaker, with a final
    /// note, because a damaged file may cause one per block.
    void add_library_message(std::string_view speaker, const std::string& line);
    /// Keeps all further warnings for take().
    void hold();
    /// Returns the warnings added since the last call.
    [[nodiscard]] std::vector<std::string> take();

  private:
    void tell(const std::string& text);

    std::mutex mutex_;
    Listener listener_;
    bool held_ = false;
    std::vector<std::string> said_;     ///< all texts so far
    std::vector<std::string> waiting_;  ///< texts not yet taken
};

}  // namespace d2b
