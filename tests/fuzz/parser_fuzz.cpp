// libFuzzer target: any bytes go through lexer and parser. Must not crash or hang, and the tree must be lossless:
// printing it gives the source text back.

#include "frontend/syntax/parser.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const char* names[] = {"fuzz.modx", "fuzz.mod"};
    for (const char* name : names) {
        auto source =
            std::make_shared<const rapid::SourceFile>(name, std::string(reinterpret_cast<const char*>(data), size));
        if (source->isBinary()) continue;
        rapid::diag::Sink sink;
        auto tree = rapid::syntax::parse(source, sink);
        if (rapid::syntax::printSource(*tree) != source->text()) {
            std::fputs("the tree does not give the source text back\n", stderr);
            std::abort();
        }
        rapid::syntax::printTree(*tree);
    }
    return 0;
}
