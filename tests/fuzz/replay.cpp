// Replaces libFuzzer for other compilers: runs a target on the files of a folder, and on so many made of
// them by changing some bytes.
//   replay <folder> <count>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

std::vector<Input> inputs_of(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Input> inputs;
    for (const auto& path : files) {
        std::ifstream file(path, std::ios::binary);
        inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return inputs;
}

Input changed(Input input, std::mt19937& random) {
    const std::size_t changes = 1 + random() % 8;
    for (std::size_t i = 0; i < changes && !input.empty(); ++i) {
        const std::size_t at = random() % input.size();
        if (random() % 4 != 0)
            input[at] = static_cast<std::uint8_t>(random());
        else if (random() % 2 == 0)
            input.insert(input.begin() + static_cast<std::ptrdiff_t>(at),
                         static_cast<std::uint8_t>(random()));
        else
            input.resize(at);
    }
    return input;
}

void keep(const Input& input) {
    // Keeps the input, because the target may end the program on it.
    std::ofstream file("last_input", std::ios::binary);
    for (const std::uint8_t byte : input)
        file.put(static_cast<char>(byte));
}

void run(const Input& input) {
    keep(input);
    LLVMFuzzerTestOneInput(input.data(), input.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: replay <folder> <count>\n";
        return 2;
    }
    const std::vector<Input> inputs = inputs_of(argv[1]);
    if (inputs.empty()) {
        std::cerr << argv[1] << " has no file\n";
        return 1;
    }
    for (const Input& input : inputs)
        run(input);
    std::mt19937 random(1);
    const int count = std::stoi(argv[2]);
    for (int i = 0; i < count; ++i)
        run(changed(inputs[static_cast<std::size_t>(i) % inputs.size()], random));
    std::cout << inputs.size() << " files and " << count << " made of them\n";
    return 0;
}
