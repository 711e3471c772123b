#pragma once

#include <array>
#include <pty.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace d2b::test {

/// Runs a command in a terminal of its own, as a user sees it. @return the text of the terminal, lines ended
/// by
/// "\n" @throws std::runtime_error where there is no terminal to be had
inline std::string run_in_terminal(const std::vector<std::string>& command, const std::string& folder) {
    int terminal = -1;
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child < 0)
        throw std::runtime_error("no pseudo-terminal");
    if (child == 0) {
        std::vector<char*> words;
        for (const std::string& word : command)
            words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        if (::chdir(folder.c_str()) == 0)
            ::execv(words[0], words.data());
        ::_exit(127);
    }
    std::string shown;
    std::array<char, 4096> buffer{};
    // Linux says EIO when the last process is gone.
    for (ssize_t got = 0; (got = ::read(terminal, buffer.data(), buffer.size())) > 0;)
        for (const char letter : std::string(buffer.data(), static_cast<std::size_t>(got)))
            if (letter != '\r')
                shown += letter;
    ::close(terminal);
    ::waitpid(child, nullptr, 0);
    return shown;
}

}  // namespace d2b::test
