#pragma once

#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/report.hpp"

namespace d2b {

/// Progress on one line, as GDAL's programs show it: "0...10...20" up to "100 - done.".
class TerminalProgress {
  public:
    explicit TerminalProgress(std::ostream& out) : out_(out) {}
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;
    /// Ends a line that was begun.
    ~TerminalProgress();

    /// @param share done, 0 to 1; a share below the last one adds nothing
    void update(double share);
    /// Calls `say`, which writes a line to the same terminal: at the beginning of a line, and progress goes
    /// on in one of its own.
    /// @param shared whether they share a terminal; progress is one line else
    void interrupt(bool shared, const std::function<void()>& say);

  private:
    [[nodiscard]] bool line_is_open() const;

    std::ostream& out_;
    std::mutex mutex_;         // warnings may come from threads that read
    int ticks_ = -1;           // the last one that was printed, of 40
    bool line_begun_ = false;  // by ticks after it, where a line came between them
};

/// Callbacks that print warnings and progress, and stop where a signal asks for it. @param progress must
/// outlive them @param quiet true to print no progress
[[nodiscard]] Callbacks terminal_callbacks(TerminalProgress& progress, bool quiet);

/// Counts of the written features on a line: "1,234 buildings and 5,678 contours in delft.gpkg"; and the
/// report's other counts: "(left out: 12 below -min_area, 3 below -min_confidence; filled: 5 holes)".
/// @param layers of the destination
[[nodiscard]] std::string summary(const RunReport& report, Layers layers, const std::string& destination);

/// Returns one line with the option that would improve most buildings, or "" if none would improve one in
/// twenty: "23 of 96 buildings have a confidence below 0.9: -min_confidence 0.9 -write_doubtful ...".
[[nodiscard]] std::string advice(const RunReport& report, const Options& options);

}  // namespace d2b
