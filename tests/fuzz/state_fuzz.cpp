// libFuzzer target: any bytes as the state of a controller. A state that was read can be written and reads back the same.

#include "fuzz_support.h"
#include "runtime/host/saved_state.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using rapid::fuzz::require;
    rt::StateImage image;
    if (!rt::readImage(rapid::fuzz::bytesOf(data, size), image).empty()) return 0;
    const std::string text = rt::writeImage(image);
    rt::StateImage again;
    require(rt::readImage(text, again).empty(), "what was read cannot be read again");
    require(rt::writeImage(again) == text, "what was read reads back as something else");
    return 0;
}
