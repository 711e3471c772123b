// Whatever a plan.json holds, it is taken or refused in a sentence; a plan that is taken is written as read.
#include <span>
#include <string>

#include "dem2buildings/error.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_tiles/plan_file.hpp"
#include "fuzz/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b;
    std::string bytes(reinterpret_cast<const char*>(data), size);
    // Seeds outlive versions.
    const std::string any = R"("version": "*")";
    if (const std::size_t at = bytes.find(any); at != std::string::npos)
        bytes.replace(at, any.size(), R"("version": ")" + std::string(version) + '"');
    try {
        const TilePlan plan = plan_from("work", bytes).plan;
        test::demand(plan.side >= 1 && plan.side <= TilePlan::most_side && plan.tiles >= 1,
                     "there are tiles");
        test::demand(plan.window.rows >= 0 && plan.window.cols >= 0, "a window is no less than empty");
        const TilePlan again = plan_from("work", plan_text(plan, {})).plan;
        test::demand(again.words == plan.words && again.folder == plan.folder && again.files == plan.files &&
                         again.window == plan.window && again.tiles == plan.tiles &&
                         again.side == plan.side && again.parts == plan.parts && again.layers == plan.layers,
                     "it is written as it was");
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
