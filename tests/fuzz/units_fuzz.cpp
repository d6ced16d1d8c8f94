// libFuzzer target: any bytes as what an executable and rapidc say to each other when a module is loaded. An answer that was
// read can be written and reads back the same.

#include "fuzz_support.h"
#include "runtime/host/unit_messages.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using rapid::fuzz::require;
    const auto bytes = rapid::fuzz::bytesOf(data, size);
    (void)rt::readUnitRequest(bytes);
    const auto answer = rt::readUnitAnswer(bytes);
    if (!answer) return 0;
    const std::string text = rt::writeUnitAnswer(*answer);
    const auto again = rt::readUnitAnswer(text);
    require(again.has_value(), "what was read cannot be read again");
    require(rt::writeUnitAnswer(*again) == text, "what was read reads back as something else");
    return 0;
}
